/* scene_springs.c - see scene_springs.h. */
#include "scene_springs.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static void join(struct dyn_network *network, int a, int b)
{
    struct dyn_spring spring = dyn_spring_usual();
    spring.end[0] = a;
    spring.end[1] = b;
    enum dyn_status status = dyn_spring_add(network, &spring, NULL);
    assert(status == DYN_OK);
}

struct stage *scene_springs(const char *word, double bottom, struct font_face *face)
{
    enum { LETTERS_MAX = 64 };
    struct stage_springs_letter letters[LETTERS_MAX];
    struct stage_springs_def def = stage_springs_def_default();
    struct stage_def stage_def = stage_def_default();
    struct stage *stage;
    int count = (int)strlen(word);
    enum dyn_status made = dyn_network_create(&def.network);
    assert(made == DYN_OK && count <= LETTERS_MAX);
    for (int i = 0; i < count; i++) {
        static const double corners[4][2] = {{0, 1.2}, {1, 1.2}, {1, 0}, {0, 0}};
        struct stage_springs_letter *l = &letters[i];
        l->letter = (struct stage_letter){
            face, font_face_glyph(face, (unsigned char)word[i]), 100, 0, -90, 83, 10, {0}};
        for (int k = 0; k < 4; k++) {
            struct dyn_mass mass = dyn_mass_usual();
            mass.x = 1.1 * i + corners[k][0];
            mass.y = bottom + corners[k][1];
            made = dyn_mass_add(def.network, &mass, &l->masses[k]);
            assert(made == DYN_OK);
        }
        for (int k = 0; k < 4; k++)
            for (int j = k + 1; j < 4; j++)
                join(def.network, l->masses[k], l->masses[j]);
        if (i) {
            join(def.network, letters[i - 1].masses[1], l->masses[0]);
            join(def.network, letters[i - 1].masses[2], l->masses[3]);
        }
    }
    def.letters = letters;
    def.letters_count = count;
    enum stage_status status = stage_springs_create(&def, &stage_def.actor);
    assert(status == STAGE_OK);
    status = stage_create(&stage_def, &stage);
    assert(status == STAGE_OK);
    return stage;
}
