/* springs.c - see springs.h. springs_hand.c handles the pointer, springs_draw.c draws. */
#include "springs.h"

#include <collide.h>
#include <events.h>
#include <hand.h>
#include <step.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "springs_internal.h"

enum { OWN_ROWS = 7 };

struct stage_springs_def stage_springs_def_default(void)
{
    return (struct stage_springs_def){.show_masses = true, .show_springs = true};
}

/* ---- controls ---- */

static double world_read(void *actor, int index)
{
    const struct springs *s = actor;
    return control_read(&dyn_controls[index], dyn_network_world(s->network));
}

static unsigned world_write(void *actor, int index, double value)
{
    struct springs *s = actor;
    struct dyn_world world = *dyn_network_world(s->network);
    enum dyn_status status = dyn_control_write(&dyn_controls[index], &world, value);
    if (status == DYN_OK)
        status = dyn_network_world_set(s->network, &world);
    return status == DYN_OK ? STAGE_OK : springs_fail(status);
}

static double *own_setting(struct springs *s, int index)
{
    struct springs_settings *set = &s->set;
    double *const settings[OWN_ROWS] = {
        &set->hand,        &set->show_masses, &set->show_springs, &set->show_letters,
        &set->full_strain, &set->collide,     &set->record_hand};
    return settings[index];
}

static double own_read(void *actor, int index)
{
    return *own_setting(actor, index);
}

static unsigned own_write(void *actor, int index, double value)
{
    *own_setting(actor, index) = value;
    return STAGE_OK;
}

static const struct control own_rows[OWN_ROWS] = {
    {"hand", "kg/s2", 1, 1e5, 300, CONTROL_LOGARITHMIC, NULL, "how stiff the hand's spring is",
     own_read, own_write, 0},
    {"show_masses", "", 0, 1, 1, CONTROL_SWITCH, NULL, "masses are seen", own_read, own_write,
     1},
    {"show_springs", "", 0, 1, 1, CONTROL_SWITCH, NULL, "springs are seen, coloured by strain",
     own_read, own_write, 2},
    {"show_letters", "", 0, 1, 1, CONTROL_SWITCH, NULL, "letters are seen", own_read, own_write,
     3},
    {"full_strain", "", 0.001, 10, 0.25, CONTROL_LOGARITHMIC, NULL,
     "the strain at which a spring has all of its colour", own_read, own_write, 4},
    {"collide", "", 0, 1, 0, CONTROL_SWITCH, NULL, "letters push each other apart", own_read,
     own_write, 5},
    {"record_hand", "", 0, 1, 0, CONTROL_SWITCH, NULL,
     "what a hand holds becomes a script of clamps, saved beside the rest", own_read, own_write,
     6}};

/* Of the word's style. */
static double style_read(void *actor, int index)
{
    const struct springs *s = actor;
    return control_read(&dyn_word_controls[index], &s->set.style);
}

static unsigned style_write(void *actor, int index, double value)
{
    struct springs *s = actor;
    struct dyn_word_style style = s->set.style;
    enum dyn_status status = dyn_control_write(&dyn_word_controls[index], &style, value);
    if (status == DYN_OK)
        status = dyn_word_style_set(s->text->word, s->network, &style);
    if (status != DYN_OK)
        return springs_fail(status);
    s->set.style = style;
    return STAGE_OK;
}

static struct control row_of(const struct control *c, int index,
                             double (*read)(void *actor, int index),
                             unsigned (*write)(void *actor, int index, double value))
{
    struct control row = *c;
    row.read = read;
    row.write = write;
    row.at = index;
    return row;
}

/* A style's choices (box, tacks) take effect only when the word is made, so they are not
 * rows. */
static enum stage_status rows_make(struct springs *s, struct font_face *face)
{
    int most = OWN_ROWS + dyn_controls_count + (s->text->word ? dyn_word_controls_count : 0) +
               SPRINGS_AXES_ROWS;
    s->rows = calloc((size_t)most, sizeof *s->rows);
    if (!s->rows)
        return stage_fail(STAGE_NO_MEMORY, "no memory for springs");
    memcpy(s->rows, own_rows, sizeof own_rows);
    s->rows_count = OWN_ROWS;
    for (int i = 0; s->text->word && i < dyn_word_controls_count; i++)
        if (dyn_word_controls[i].curve != CONTROL_CHOICE)
            s->rows[s->rows_count++] =
                row_of(&dyn_word_controls[i], i, style_read, style_write);
    for (int i = 0; i < dyn_controls_count; i++)
        s->rows[s->rows_count++] = row_of(&dyn_controls[i], i, world_read, world_write);
    s->axes_rows = springs_axes_find(s, face, s->rows + s->rows_count);
    s->rows_count += s->axes_rows;
    return STAGE_OK;
}

static const struct control *springs_controls(void *actor, int *count)
{
    const struct springs *s = actor;
    *count = s->rows_count;
    return s->rows;
}

static const char *springs_group(void *actor, int row)
{
    const struct springs *s = actor;
    const int world = s->rows_count - s->axes_rows - dyn_controls_count;
    return row >= s->rows_count - s->axes_rows ? "font"
           : row < OWN_ROWS                    ? "look and hand"
           : row < world                       ? "letters and their springs"
                                               : "world";
}

/* ---- time ---- */

static enum stage_status springs_step(void *actor, double dt_s)
{
    struct springs *s = actor;
    enum dyn_status status = s->clamps ? dyn_clamps_step(s->clamps, s->network, dt_s, 1)
                                       : dyn_network_step(s->network, dt_s, 1);
    const struct dyn_word *const word = s->text->word;
    if (status == DYN_OK && word && s->set.collide != 0)
        status = dyn_words_collide(s->network, &word, 1, NULL);
    if (status == DYN_OK && s->set.record_hand != 0)
        status = springs_record(s);
    return status == DYN_OK ? STAGE_OK : springs_fail(status);
}

static int springs_heard(void *actor, struct stage_sound *out, int most)
{
    struct springs *s = actor;
    struct dyn_event event;
    int count = 0;
    while (count < most && dyn_events_take(s->network, &event, 1) > 0)
        out[count++] = (struct stage_sound){.name = dyn_event_name(event.kind),
                                            .time_s = event.time_s,
                                            .strength = event.strength,
                                            .x = event.x,
                                            .y = event.y};
    return count;
}

/* ---- going back ---- */

struct kept {
    struct dyn_network *network;
    struct springs_text *text;
    struct springs_settings set;
};

static void springs_forget(void *state)
{
    struct kept *kept = state;
    if (kept)
        dyn_network_destroy(kept->network);
    if (kept)
        springs_text_let(kept->text);
    free(kept);
}

static enum stage_status springs_keep(void *actor, void **state)
{
    const struct springs *s = actor;
    struct kept *kept = calloc(1, sizeof *kept);
    *state = NULL;
    if (!kept)
        return stage_fail(STAGE_NO_MEMORY, "no memory to keep springs as they are");
    kept->set = s->set;
    kept->text = s->text;
    kept->text->users++;
    enum dyn_status status = dyn_network_create(&kept->network);
    if (status == DYN_OK)
        status = dyn_network_copy_state(kept->network, s->network);
    if (status != DYN_OK) {
        springs_forget(kept);
        return springs_fail(status);
    }
    *state = kept;
    return STAGE_OK;
}

static enum stage_status springs_restore(void *actor, const void *state)
{
    struct springs *s = actor;
    const struct kept *kept = state;
    enum dyn_status status = dyn_network_copy_state(s->network, kept->network);
    if (status != DYN_OK)
        return springs_fail(status);
    s->set = kept->set;
    kept->text->users++;
    springs_text_let(s->text);
    s->text = kept->text;
    stage_axes_put(&s->axes, &s->set.axes);
    s->hand = (struct springs_hand){0};
    return STAGE_OK;
}

/* ---- an actor ---- */

static struct font_box springs_extent(void *actor)
{
    const struct springs *s = actor;
    const struct dyn_state *states = dyn_network_states(s->network);
    const struct dyn_world *world = dyn_network_world(s->network);
    if (s->text->extent.x1 > s->text->extent.x0 && s->text->extent.y1 > s->text->extent.y0)
        return s->text->extent;
    struct font_box box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < dyn_masses_count(s->network); i++) {
        box.x0 = fmin(box.x0, states[i].x);
        box.x1 = fmax(box.x1, states[i].x);
        box.y0 = fmin(box.y0, states[i].y);
        box.y1 = fmax(box.y1, states[i].y);
    }
    if (!(box.x1 >= box.x0))
        box = (struct font_box){-1, -1, 1, 1};
    if (world->floor_on != 0 && fabs(box.y0 - world->floor) < 100)
        box.y0 = fmin(box.y0, world->floor);
    double margin = fmax(0.5, 0.12 * fmax(box.x1 - box.x0, box.y1 - box.y0));
    return (struct font_box){box.x0 - margin, box.y0 - margin, box.x1 + margin,
                             box.y1 + margin};
}

static void springs_destroy(void *actor)
{
    struct springs *s = actor;
    dyn_clamps_destroy(s->clamps);
    dyn_clamps_destroy(s->recorded);
    springs_text_let(s->text);
    dyn_network_destroy(s->network);
    free(s->rows);
    free(s);
}

static const struct stage_actor_kind springs_kind = {.name = "springs",
                                                     .controls = springs_controls,
                                                     .step = springs_step,
                                                     .draw = springs_draw,
                                                     .event = springs_event,
                                                     .extent = springs_extent,
                                                     .keep = springs_keep,
                                                     .restore = springs_restore,
                                                     .forget = springs_forget,
                                                     .save = springs_save,
                                                     .load = springs_load,
                                                     .digest = springs_digest,
                                                     .text = springs_text_set,
                                                     .heard = springs_heard,
                                                     .destroy = springs_destroy,
                                                     .group = springs_group};

enum stage_status stage_springs_create(const struct stage_springs_def *def,
                                       struct stage_actor *out)
{
    *out = (struct stage_actor){0};
    struct springs *s = calloc(1, sizeof *s);
    if (!s) {
        dyn_clamps_destroy(def->clamps);
        dyn_word_destroy(def->word);
        dyn_network_destroy(def->network);
        return stage_fail(STAGE_NO_MEMORY, "no memory for springs");
    }
    s->network = def->network;
    s->clamps = def->clamps;
    s->maker = def->maker;
    for (int i = 0; i < OWN_ROWS; i++)
        *own_setting(s, i) = own_rows[i].usual;
    s->set.show_masses = def->show_masses;
    s->set.show_springs = def->show_springs;
    s->set.style = def->style;
    enum stage_status status = springs_text_make(def, &s->text);
    if (status == STAGE_OK)
        status = rows_make(s, def->face);
    if (status != STAGE_OK) {
        springs_destroy(s);
        return status;
    }
    *out = (struct stage_actor){&springs_kind, s};
    return STAGE_OK;
}

struct dyn_network *stage_springs_network(const struct stage_actor *actor)
{
    return actor->kind == &springs_kind ? ((struct springs *)actor->self)->network : NULL;
}
