#!/bin/sh
# Builds taut and renders 15 s of film: PNG frames and a video. Run again at will; nothing outside the checkout changes
# but packages that were missing.
exec sh "$(dirname "$0")/film.sh" demo
