// The further lights: LAMPS of them, of which the first LAMP_SHADOWS throw shadows. After shadow.glsl.
#if LAMP_SHADOWS > 0
uniform sampler2DShadow lampMaps[LAMP_SHADOWS];
uniform sampler2D lampDepths[LAMP_SHADOWS];
uniform sampler2D lampBounds[LAMP_SHADOWS];
#define LAMP_REACHING(i)                                                                                        \
    reaching(place, facing, pixel, casts, lamps[i].toMap, mat3(lamps[i].toLight), lamps[i].mapSize, lamps[i].way.w, \
             lamps[i].colour.w, lampMaps[i], lampDepths[i], lampBounds[i])
#endif

// As sunlight(); `lamp` must be a constant.
float lamplight(int lamp, vec3 place, vec3 facing, float pixel, bool casts) {
#if LAMP_SHADOWS > 0
    if (lamp == 0) return LAMP_REACHING(0);
#endif
#if LAMP_SHADOWS > 1
    if (lamp == 1) return LAMP_REACHING(1);
#endif
    return 1.0;
}
