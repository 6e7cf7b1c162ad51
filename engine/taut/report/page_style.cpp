#include "taut/report/page_parts.h"

namespace taut::report {

std::string_view pageStyle() {
    return R"css(
:root {
  color-scheme: light;
  --page: #f6f6f4; --card: #ffffff; --line: #e2e1dc; --text: #1d1d1b; --quiet: #6b6a66; --faint: #efeeea;
  --good: #1f7a4d; --bad: #b3261e; --gap: #9a6700; --halt: #7a1fa2; --skip: #6b6a66; --accent: #2456a6;
  --shade: 0 1px 2px rgba(0,0,0,.05), 0 6px 24px rgba(0,0,0,.04);
}
:root[data-theme="dark"] {
  color-scheme: dark;
  --page: #141416; --card: #1d1d20; --line: #303035; --text: #ececea; --quiet: #9a9a9f; --faint: #26262a;
  --good: #58c38c; --bad: #ff8078; --gap: #e3b341; --halt: #cf8cf0; --skip: #9a9a9f; --accent: #86b0f5;
  --shade: none;
}
* { box-sizing: border-box; }
body {
  margin: 0; background: var(--page); color: var(--text);
  font: 15px/1.5 system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif;
}
main { max-width: 1240px; margin: 0 auto; padding: 28px 24px 64px; }
h1 { font-size: 24px; font-weight: 650; margin: 0; letter-spacing: -.01em; }
h2 { font-size: 17px; font-weight: 650; margin: 0; }
h3 { font-size: 12px; font-weight: 650; margin: 22px 0 8px; color: var(--quiet); text-transform: uppercase; letter-spacing: .07em; }
code, .mono { font-family: ui-monospace, "SF Mono", "DejaVu Sans Mono", monospace; font-size: .88em; }
button { font: inherit; color: inherit; background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 5px 12px; cursor: pointer; }
button:hover { border-color: var(--quiet); }
button[aria-pressed="true"] { background: var(--text); color: var(--page); border-color: var(--text); }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }

.top { display: flex; gap: 16px; align-items: center; margin-bottom: 4px; }
.top .space { flex: 1; }
.facts { color: var(--quiet); font-size: 13px; margin-bottom: 20px; }
.tiles { display: flex; gap: 12px; margin: 18px 0; flex-wrap: wrap; }
.tile { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 12px 18px; min-width: 120px; box-shadow: var(--shade); }
.tile b { display: block; font-size: 26px; line-height: 1.15; font-weight: 650; font-variant-numeric: tabular-nums; }
.tile span { color: var(--quiet); font-size: 13px; }
.bar { display: flex; gap: 8px; align-items: center; margin: 0 0 14px; }

.passed { color: var(--good); } .failed { color: var(--bad); } .missing, .outdated { color: var(--gap); }
.diverged { color: var(--halt); } .skipped { color: var(--skip); }
.mark { display: inline-flex; align-items: center; gap: 7px; font-weight: 600; white-space: nowrap; }
.mark::before { content: ""; width: 9px; height: 9px; border-radius: 50%; background: currentColor; }
.mark.failed::before { border-radius: 2px; }
.mark.missing::before, .mark.outdated::before { background: none; border: 2px solid currentColor; }
.mark.diverged::before { border-radius: 0; transform: rotate(45deg); }

.scenario { background: var(--card); border: 1px solid var(--line); border-radius: 14px; margin-bottom: 14px; box-shadow: var(--shade); }
.scenario > summary { list-style: none; cursor: pointer; display: grid; grid-template-columns: 110px minmax(0, 1fr) auto; gap: 16px; align-items: center; padding: 14px 20px; }
.scenario > summary::-webkit-details-marker { display: none; }
.scenario > summary .title { color: var(--quiet); font-weight: 400; margin-left: 10px; font-size: 14px; }
.scenario > summary .counts { color: var(--quiet); font-size: 13px; display: flex; gap: 18px; font-variant-numeric: tabular-nums; }
.scenario > .inside { padding: 0 20px 22px; border-top: 1px solid var(--line); }
body.only-failing .scenario.is-good { display: none; }

table { border-collapse: collapse; width: 100%; font-size: 14px; }
th { text-align: left; font-weight: 600; color: var(--quiet); font-size: 12px; padding: 4px 12px 4px 0; }
td { padding: 6px 12px 6px 0; border-top: 1px solid var(--line); vertical-align: top; }
td code, td.mono { white-space: nowrap; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
.reason { border-left: 3px solid currentColor; padding: 8px 12px; border-radius: 0 8px 8px 0; background: var(--faint); margin: 10px 0 0; white-space: pre-wrap; overflow-wrap: anywhere; font-size: 14px; }
.reason > span { color: var(--text); }
.reason + .scenario { margin-top: 14px; }
.quiet { color: var(--quiet); }
.small { font-size: 13px; }

.viewer { margin-top: 6px; }
.scrub { display: grid; grid-template-columns: auto 1fr; gap: 0 24px; align-items: center; margin: 4px 0 14px; }
.scrub .now { display: flex; gap: 12px; min-width: 230px; font-variant-numeric: tabular-nums; }
.scrub input { width: 100%; accent-color: var(--accent); margin: 0; }
.stops { grid-column: 2; display: flex; justify-content: space-between; height: 22px; padding: 0 1px; }
.stops button { border: 0; background: none; padding: 0; width: 14px; font-size: 12px; line-height: 1; display: flex; flex-direction: column; align-items: center; gap: 3px; font-variant-numeric: tabular-nums; }
.stops button::before { content: ""; width: 2px; height: 7px; background: currentColor; border-radius: 1px; }
.stops button.on { font-weight: 700; }
.stage { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 12px; }
figure { margin: 0; }
figcaption { display: flex; justify-content: space-between; font-size: 13px; color: var(--quiet); padding: 0 2px 5px; }
figcaption b { color: var(--text); font-weight: 600; }
.frame { position: relative; border-radius: 10px; overflow: hidden; background: var(--faint); border: 1px solid var(--line); aspect-ratio: 16 / 9; }
.frame img { display: block; width: 100%; height: 100%; object-fit: contain; }
.tile-mark { position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none; }
.tile-mark rect { fill: none; stroke: #000; stroke-width: 4px; vector-effect: non-scaling-stroke; }
.tile-mark rect + rect { stroke: #ffd400; stroke-width: 2px; }
.frame [hidden] { display: none !important; }
.frame .none { position: absolute; inset: 0; display: grid; place-items: center; color: var(--quiet); font-size: 14px; }
.frame.swaps { cursor: crosshair; }
.frame.swapped { border-color: var(--accent); box-shadow: 0 0 0 2px var(--accent); }
.note { margin: 10px 2px 0; font-size: 14px; }

.command { display: flex; gap: 10px; align-items: stretch; margin-top: 10px; }
.command code { flex: 1; background: var(--faint); border: 1px solid var(--line); border-radius: 8px; padding: 8px 12px; min-width: 0; white-space: pre-wrap; overflow-wrap: anywhere; }
.command button { align-self: flex-start; }
.diff { background: var(--faint); border: 1px solid var(--line); border-radius: 8px; padding: 6px 0; }
.diff div { display: grid; grid-template-columns: 44px 1fr; gap: 12px; padding: 0 12px; }
.diff span { color: var(--quiet); text-align: right; font-size: 12px; font-variant-numeric: tabular-nums; }
.diff code { white-space: pre-wrap; overflow-wrap: anywhere; }
.diff .same code { color: var(--quiet); }
.diff .gone { background: color-mix(in srgb, var(--bad) 12%, transparent); }
.diff .added { background: color-mix(in srgb, var(--good) 12%, transparent); }
.cal td { padding: 5px 12px 5px 0; }
footer { color: var(--quiet); font-size: 13px; margin-top: 28px; }
@media (max-width: 900px) { .stage { grid-template-columns: 1fr; } .scenario > summary { grid-template-columns: 1fr; } }
)css";
}

}  // namespace taut::report
