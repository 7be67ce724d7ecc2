/* spring_scene.c - see spring_scene.h. */
#include "spring_scene.h"
#include "spring_reach.h"

#include <clamps.h>
#include <edits.h>
#include <network_file.h>
#include <springs.h>
#include <word.h>

#include <math.h>
#include <string.h>

/* The number of points of a circle, and the length of a straight baseline's path in ems. */
enum { CIRCLE_POINTS = 721 };
static const double line_length = 10000;

struct spring_scene_def spring_scene_def_default(void)
{
    return (struct spring_scene_def){
        .font = "DejaVuSans", .theme = "light", .at = {0, NAN}, .view = {NAN, 0, 0, 0}};
}

static enum stage_status fail_dyn(enum dyn_status status)
{
    return stage_fail(status == DYN_BAD_ARGUMENT ? STAGE_BAD_ARGUMENT
                      : status == DYN_NO_MEMORY  ? STAGE_NO_MEMORY
                                                 : STAGE_BAD_FILE,
                      "%s", dyn_error());
}

/* ---- controls of a word's style, which are set before the word is made ---- */

/* The style's control that NAME=VALUE sets; NULL: none. */
static const struct control *style_row(const char *assignment)
{
    size_t length = strcspn(assignment, "=");
    for (int i = 0; i < dyn_word_controls_count; i++)
        if (strlen(dyn_word_controls[i].name) == length &&
            strncmp(dyn_word_controls[i].name, assignment, length) == 0)
            return &dyn_word_controls[i];
    return NULL;
}

static enum stage_status style_set(const struct spring_scene_def *def,
                                   struct dyn_word_style *style)
{
    for (int i = 0; i < def->sets_count; i++) {
        const struct control *row = style_row(def->sets[i]);
        const char *equals = strchr(def->sets[i], '=');
        double value;
        if (!row || !equals)
            continue;
        enum dyn_status status = dyn_control_parse(row, equals + 1, &value);
        if (status == DYN_OK)
            status = dyn_control_write(row, style, value);
        if (status != DYN_OK)
            return fail_dyn(status);
    }
    return STAGE_OK;
}

/* ---- words ---- */

static enum stage_status font_open(const struct spring_scene_def *def, struct spring_scene *out)
{
    if (font_edits_open(def->font, 0, false, &out->face) != FONT_OK ||
        font_shaper_create(out->face, &out->shaper) != FONT_OK)
        return stage_fail(STAGE_FAILED, "%s", font_error());
    return STAGE_OK;
}

/* How far the last baseline is below the first, in ems. */
static double lines_height(const struct spring_scene_def *def, const struct spring_scene *scene)
{
    enum { PX = 100 };
    struct font_text_options options = {.width_px = def->column * PX};
    struct font_layout layout;
    double height = 0;
    if (font_shaper_layout(scene->shaper, def->text, strlen(def->text), PX, &options,
                           &layout) == FONT_OK) {
        if (layout.lines_count)
            height = layout.lines[layout.lines_count - 1].y_px / PX;
        font_layout_finish(&layout);
    }
    return height; /* where it fails, the word fails, too, and says why */
}

/* With its baseline at that height. *letters (NULL is fine): of its longest line. */
static enum stage_status word_put(const struct spring_scene_def *def,
                                  const struct spring_scene *scene,
                                  struct stage_springs_def *springs, double y, int *letters)
{
    double x = def->at[0], path[CIRCLE_POINTS][2];
    struct dyn_word_def word = dyn_word_def_usual();
    struct dyn_world world = *dyn_network_world(springs->network);
    word.text = def->text;
    word.shaper = scene->shaper;
    word.x = x;
    word.y = y;
    word.width = def->column;
    if (def->circle > 0) {
        dyn_path_circle(x, y, def->circle, 90 + def->turn, path, CIRCLE_POINTS);
        word.path_count = CIRCLE_POINTS;
    } else if (def->turn != 0) {
        double angle = def->turn * M_PI / 180;
        path[0][0] = x;
        path[0][1] = y;
        path[1][0] = x + line_length * cos(angle);
        path[1][1] = y + line_length * sin(angle);
        word.path_count = 2;
    }
    word.path = word.path_count ? (const double(*)[2])path : NULL;
    enum dyn_status status = DYN_OK;
    if (def->preset)
        status = dyn_preset_apply(def->preset, &word.style, &world);
    if (status == DYN_OK && def->preset)
        status = dyn_preset_fit(def->preset, &word, letters);
    if (status == DYN_OK)
        status = dyn_network_world_set(springs->network, &world);
    enum stage_status set = status == DYN_OK ? style_set(def, &word.style) : fail_dyn(status);
    if (set != STAGE_OK)
        return set;
    springs->style = word.style;
    status = dyn_word_create(springs->network, &word, &springs->word);
    return status == DYN_OK ? STAGE_OK : fail_dyn(status);
}

/* A word that hangs, and does not break. */
static bool hangs(const struct dyn_word_style *style)
{
    return style->tack != DYN_TACK_NONE && style->letter_breaking == 0 &&
           style->link_breaking == 0;
}

static const double above_floor = 0.5; /* ems */

static enum stage_status word_put_again(const struct spring_scene_def *def,
                                        const struct spring_scene *scene,
                                        struct stage_springs_def *springs, double y)
{
    dyn_word_destroy(springs->word);
    dyn_network_destroy(springs->network);
    springs->word = NULL;
    springs->network = NULL;
    const enum dyn_status made = dyn_network_create(&springs->network);
    return made == DYN_OK ? word_put(def, scene, springs, y, NULL) : fail_dyn(made);
}

/* How much higher than others a word that breaks begins, of so many letters: a long one breaks
 * before the floor bears it. */
static double break_lift(const struct spring_scene_def *def, int letters)
{
    enum { LONG = 10 };
    return isnan(def->at[1]) ? fmin(2, fmax(0, (letters - LONG) / 3.0)) : 0; /* ems */
}

/* A word that hangs is so high that it does not reach the floor, and all that it will do is
 * seen. */
static enum stage_status word_fit(const struct spring_scene_def *def,
                                  const struct spring_scene *scene,
                                  struct stage_springs_def *springs, double y, int letters)
{
    const bool placed = !isnan(def->at[1]);
    struct font_box box;
    if (def->preset && dyn_preset_collides(def->preset)) {
        const double lift = break_lift(def, letters);
        return lift > 0 ? word_put_again(def, scene, springs, y + lift) : STAGE_OK;
    }
    if (!hangs(&springs->style) || (placed && !isnan(def->view[0])))
        return STAGE_OK;
    enum stage_status status =
        spring_reach(springs->network, def->sets, def->sets_count, !placed, &box);
    const double floor = dyn_network_world(springs->network)->floor,
                 lift = placed ? 0 : fmax(0, floor + above_floor - box.y0);
    if (status == STAGE_OK && lift > 0)
        status = word_put_again(def, scene, springs, y + lift);
    if (status != STAGE_OK || !isnan(def->view[0]))
        return status;
    const double bottom = fmin(box.y0 + lift, floor), top = box.y1 + lift;
    const double margin = fmax(0.5, 0.06 * fmax(box.x1 - box.x0, top - bottom));
    springs->extent =
        (struct font_box){box.x0 - margin, bottom - margin, box.x1 + margin, top + margin};
    return STAGE_OK;
}

/* Nothing begins below the floor. */
static double height_usual(const struct spring_scene_def *def, const struct spring_scene *scene)
{
    return isnan(def->at[1]) ? 2 + (def->circle > 0 ? def->circle : lines_height(def, scene))
                             : def->at[1];
}

/* ---- a scene ---- */

/* A script of other masses than there are is refused before the first picture. */
static enum stage_status script_read(const char *path, struct stage_springs_def *springs)
{
    enum dyn_status status = dyn_clamps_read(path, &springs->clamps);
    if (status != DYN_OK)
        return fail_dyn(status);
    if (dyn_clamps_step(springs->clamps, springs->network, 1, 0) != DYN_OK)
        return stage_fail(STAGE_BAD_FILE, "%s: %s", path, dyn_error());
    return STAGE_OK;
}

/* For stage_text(): the word as it was made, of other words. */
static enum stage_status word_again(void *context, const char *words,
                                    struct stage_springs_def *out)
{
    const struct spring_scene *scene = context;
    struct spring_scene_def def = scene->def;
    def.text = words;
    const enum dyn_status made = dyn_network_create(&out->network);
    if (made != DYN_OK)
        return fail_dyn(made);
    const double y = height_usual(&def, scene);
    int letters = 0;
    enum stage_status status = word_put(&def, scene, out, y, &letters);
    if (!isnan(def.view[0]))
        out->extent = (struct font_box){def.view[0], def.view[1], def.view[2], def.view[3]};
    if (status == STAGE_OK)
        status = word_fit(&def, scene, out, y, letters);
    if (status != STAGE_OK) {
        dyn_word_destroy(out->word);
        dyn_network_destroy(out->network);
    }
    return status;
}

static enum stage_status springs_make(const struct spring_scene_def *def,
                                      struct spring_scene *scene,
                                      struct stage_springs_def *springs)
{
    if (def->network) {
        enum dyn_status status = dyn_network_read(def->network, &springs->network);
        if (status != DYN_OK)
            return fail_dyn(status);
    } else {
        enum dyn_status status = dyn_network_create(&springs->network);
        if (status != DYN_OK)
            return fail_dyn(status);
        enum stage_status made = font_open(def, scene);
        const double y = made == STAGE_OK ? height_usual(def, scene) : 0;
        int letters = 0;
        if (made == STAGE_OK)
            made = word_put(def, scene, springs, y, &letters);
        if (made == STAGE_OK)
            made = word_fit(def, scene, springs, y, letters);
        if (made != STAGE_OK)
            return made;
    }
    return def->script ? script_read(def->script, springs) : STAGE_OK;
}

static enum stage_status sets_do(const struct spring_scene_def *def, struct stage *stage)
{
    for (int i = 0; i < def->sets_count; i++)
        if ((def->network || !style_row(def->sets[i])) &&
            stage_set(stage, def->sets[i]) != STAGE_OK)
            return STAGE_BAD_ARGUMENT;
    return STAGE_OK;
}

enum stage_status spring_scene_make(const struct spring_scene_def *def,
                                    struct spring_scene *out)
{
    struct stage_springs_def springs = stage_springs_def_default();
    struct stage_def stage = stage_def_default();
    *out = (struct spring_scene){.def = *def};
    if (!def->network)
        springs.maker = (struct stage_springs_maker){word_again, out};
    stage.theme = def->theme;
    stage.forgets = def->forgets;
    if (!isnan(def->view[0]))
        springs.extent =
            (struct font_box){def->view[0], def->view[1], def->view[2], def->view[3]};
    enum stage_status status = springs_make(def, out, &springs);
    springs.face = out->face;
    if (status == STAGE_OK) {
        status = stage_springs_create(&springs, &stage.actor);
    } else {
        dyn_clamps_destroy(springs.clamps);
        dyn_word_destroy(springs.word);
        dyn_network_destroy(springs.network);
    }
    if (status == STAGE_OK)
        status = stage_create(&stage, &out->stage);
    if (status == STAGE_OK && def->preset && dyn_preset_collides(def->preset))
        status = stage_set(out->stage, "collide=on");
    if (status == STAGE_OK)
        status = sets_do(def, out->stage);
    if (status != STAGE_OK)
        spring_scene_finish(out);
    return status;
}

void spring_scene_finish(struct spring_scene *scene)
{
    stage_destroy(scene->stage);
    font_shaper_destroy(scene->shaper);
    font_face_close(scene->face);
    *scene = (struct spring_scene){0};
}
