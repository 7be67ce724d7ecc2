/* scenes.h - paints some sheets and prints their planes' hashes. The hashes are the same under
 * every C/Paris. */
#ifndef LUTETIA_TESTS_SCENES_H
#define LUTETIA_TESTS_SCENES_H

#include <history.h>
#include <sheet.h>

#include "../sample.h"
#include "../sheets.h"

#include <stdio.h>
#include <stdlib.h>

enum { SCENE_WIDTH = 24, SCENE_HEIGHT = 20, SCENE_TURNS = 6, SCENE_STEPS = 4 };

static inline void scene_check(enum paper_status status)
{
    if (status == PAPER_OK)
        return;
    fprintf(stderr, "%s\n", paper_error());
    exit(1);
}

/* Writes the paper's layers, because CM_u_random_1L() gives other numbers under each
 * C/Paris. */
static inline void scene_paper(struct paper_sheet *sheet, uint64_t *chance)
{
    static const float low[3] = {0, 0.02f, 0.1f}, high[3] = {1, 0.25f, 0.9f};
    static float values[SCENE_WIDTH * SCENE_HEIGHT];
    for (int layer = 0; layer < 3; layer++) {
        for (int i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++)
            values[i] = low[layer] + (high[layer] - low[layer]) *
                                         (float)(sample_word(chance) >> 40) * 0x1p-24f;
        scene_check(paper_sheet_layer_write(sheet, (enum paper_layer)layer, 0, values));
    }
}

/* Prints one line for each turn: a hash of each plane except the planes of colour. */
static inline void scene_of_sheet_play(FILE *out, bool deckled)
{
    static uint8_t gray[11 * 9];
    static uint32_t words[SCENE_WIDTH * SCENE_HEIGHT];
    struct paper_plane planes[PAPER_PLANES_MAX];
    struct paper_sheet_config config =
        sheet_of_two(SCENE_WIDTH, SCENE_HEIGHT, "quinacridone rose", "french ultramarine");
    config.torus = !deckled;
    config.deckled = deckled;
    config.deckle = (struct paper_deckle){.margin = 3, .waves = 1, .thin = 3, .fringe = 2};
    uint64_t chance = 3;
    struct paper_sheet *sheet;
    scene_check(paper_sheet_create(&config, &sheet));
    scene_check(paper_history_begin(sheet, 0));
    scene_paper(sheet, &chance);
    for (int turn = 0; turn < SCENE_TURNS; turn++) {
        for (size_t i = 0; i < sizeof gray; i++)
            gray[i] = (uint8_t)sample_word(&chance);
        struct paper_screen screen = {.width_px = 11, .height_px = 9, .gray = gray};
        scene_check(paper_sheet_put(sheet, &screen, (int)(sample_word(&chance) % 20) - 3,
                                    (int)(sample_word(&chance) % 18) - 3,
                                    (double[]){1.7, 0.9, 0.4}));
        struct paper_air air = paper_air_default();
        air.gravity[0] = 0.01 * turn + 0.001;
        air.gravity[1] = 0.02;
        air.seep[0] = -0.03;
        air.seep[1] = 0.02;
        air.humidity = 0.003;
        scene_check(paper_sheet_air(sheet, &air));
        for (int i = 0; i < SCENE_STEPS; i++) {
            scene_check(paper_sheet_step(sheet));
            scene_check(paper_sheet_finish(sheet));
        }
        int count = paper_sheet_planes(sheet, planes);
        for (int i = 0; i < count; i++) {
            uint64_t hash = 0xcbf29ce484222325u;
            scene_check(paper_sheet_plane_read(sheet, i, words));
            for (int j = 0; j < SCENE_WIDTH * SCENE_HEIGHT; j++)
                hash = (hash ^ words[j]) * 0x100000001b3u;
            if (i < 4 || i >= 10)
                fprintf(out, "sheet%s, turn %d, %s: %016llx\n", deckled ? " with a deckle" : "",
                        turn, planes[i].name, (unsigned long long)hash);
        }
    }
    paper_sheet_destroy(sheet);
}

static inline void scene_play(FILE *out)
{
    scene_of_sheet_play(out, false);
    scene_of_sheet_play(out, true);
}

#endif
