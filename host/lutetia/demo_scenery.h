/* demo_scenery.h - the marsh of the demonstration page: soft masks made of noise, and
 * reflections.
 *
 *     struct demo_mask mask = {.width_px = 1600, .height_px = 1200, .waterline_px = 640};
 *     struct paper_screen water;
 *     if (demo_mask_screen(&mask, DEMO_WATER, &water))
 *         paper_sheet_put(sheet, &water, 0, 0, amount);
 */
#ifndef LUTETIA_DEMO_SCENERY_H
#define LUTETIA_DEMO_SCENERY_H

#include <paper.h>

struct demo_mask {
    int width_px, height_px;
    int waterline_px; /* the marsh begins here, from the top */
};

enum demo_mask_kind {
    DEMO_WATER, /* how wet */
    DEMO_DEEP,  /* the marsh's own colour: darker at the waterline */
    DEMO_CLAY,  /* streaks of a warm colour */
    DEMO_REED   /* streaks of a green one */
};

/* False: no memory. Owns: the caller destroys *out. */
bool demo_mask_screen(const struct demo_mask *mask, enum demo_mask_kind kind,
                      struct paper_screen *out);

/* A letter, with its place on the sheet. */
struct demo_letter {
    struct paper_screen screen;
    int x_px, y_px; /* of the screen's upper left corner */
};

/* Adds the letter to a sheet-sized screen. */
void demo_letter_blend(const struct demo_letter *letter, struct paper_screen *sheet);

/* A reflection is put on band by band, the deepest first, so that deeper bands bleed longer. */
enum { DEMO_BANDS = 10, DEMO_REFLECTION_DEPTH_PX = 400 };

/* Blends a band (0 the deepest) of a letter's reflection into a sheet-sized screen: mirrored at
 * the letter's foot, fading and swaying more the deeper, broken by glints of light. */
void demo_reflection_blend(const struct demo_letter *letter, int band,
                           struct paper_screen *sheet);

#endif
