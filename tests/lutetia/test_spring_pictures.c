/* test_spring_pictures.c - makes the pictures in docs/stage.md and the README again by the
 * commands given there. Compares them by similarity, because fonts differ a little between
 * versions. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <display.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../display/scratch.h"
#include "../stage/likeness.h"
#include "child.h"
#include "documented.h"

static const char *lutetia, *source;

/* A picture's name stands in the document; its command is the last one before that writes it by
 * --still. */
static const struct {
    const char *document, *still, *image;
} pictures[] = {
    {"README.md", "breakdown.png", "springs-breakdown.png"},
    {"docs/stage.md", "word.png", "springs-word.png"},
    {"docs/stage.md", "skins.png", "springs-skins.png"},
    {"docs/springs.md", "paragraph.png", "springs-paragraph.png"},
    {"docs/stage.md", "falling.png", "springs-falling.png"},
    {"docs/stage.md", "collision.png", "springs-collision.png"},
    {"docs/stage.md", "network.png", "springs-network.png"},
};

static struct display_image picture(const char *path)
{
    struct display_image image;
    if (display_png_read_rgb(path, &image) != DISPLAY_OK)
        fail_msg("%s", display_error());
    return image;
}

static void pictures_are_as_documented(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++) {
        static struct child child;
        static char paths[CHILD_ARGUMENTS_MAX][4096];
        const char *words[40], *still = scratch_path("again.png");
        char wanted[100];
        snprintf(wanted, sizeof wanted, "--still %s", pictures[i].still);
        int count = documented_words(
            documented_command(source, pictures[i].document, "lutetia spring ", wanted), words,
            40);
        child = (struct child){.variables = {"DISPLAY=", "WAYLAND_DISPLAY="}};
        assert_true(count < CHILD_ARGUMENTS_MAX);
        for (int k = 0; k < count; k++) {
            child.arguments[k] = words[k];
            if (strcmp(words[k], pictures[i].still) == 0)
                child.arguments[k] = still;
            if (strncmp(words[k], "examples/", 9) == 0) {
                snprintf(paths[k], sizeof paths[k], "%s/%s", source, words[k]);
                child.arguments[k] = paths[k];
            }
        }
        child.arguments[0] = lutetia;
        child_run(&child);
        if (child.status != 0)
            fail_msg("%s: %s", pictures[i].image, child.errors);
        char path[4096];
        snprintf(path, sizeof path, "%s/docs/images/%s", source, pictures[i].image);
        struct display_image now = picture(still), then = picture(path);
        assert_true(now.width_px == then.width_px && now.height_px == then.height_px);
        double alike = likeness(&now, &then);
        if (alike < 0.97)
            fail_msg("%s: likeness %.4f", pictures[i].image, alike);
        display_image_destroy(&now);
        display_image_destroy(&then);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pictures_are_as_documented)};
    lutetia = getenv("LUTETIA");
    source = getenv("SPRINGS_SOURCE");
    if (!lutetia || !source)
        return 77;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
