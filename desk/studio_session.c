/* studio_session.c - see studio_session.h. What the single tools do is in studio_deeds.c. */
#include "studio_session_internal.h"

#include <display.h>
#include <script_session.h>
#include <state.h>

#include <stdlib.h>
#include <string.h>

#define NO_SURFACE "%s: a sheet without water on its surface; the studio paints on others"

/* ---- life ---- */

static enum paper_status session_make(struct paper_sheet *sheet, struct studio_session **out)
{
    struct studio_session *s = calloc(1, sizeof *s);
    *out = s;
    if (!s) {
        paper_sheet_destroy(sheet);
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a studio");
    }
    s->sheet = sheet;
    s->pairs = calloc(1, sizeof *s->pairs);
    if (!s->pairs) {
        studio_session_destroy(s);
        *out = NULL;
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a studio");
    }
    s->present = s->inserting = s->way = s->inserted = -1;
    studio_settings_usual(&s->settings);
    const struct paper_air *air = paper_sheet_get_air(sheet);
    s->settings.value[STUDIO_TILT_X] = air->gravity[0];
    s->settings.value[STUDIO_TILT_Y] = air->gravity[1];
    s->settings.value[STUDIO_HUMIDITY] = air->humidity;
    s->settings.value[STUDIO_EDGE] = air->edge;
    s->wet = paper_history_done(sheet) > 0; /* until a step says otherwise */
    s->settings.value[STUDIO_PAUSED] =
        s->wet; /* the moment that was saved stays until somebody lets it go on */
    return PAPER_OK;
}

enum paper_status studio_session_create(const struct paper_sheet_config *config,
                                        double budget_bytes, struct studio_session **out)
{
    struct paper_sheet *sheet;
    *out = NULL;
    enum paper_status status = paper_sheet_create(config, &sheet);
    if (status != PAPER_OK)
        return status;
    status = paper_history_begin(sheet, budget_bytes);
    if (status == PAPER_OK)
        return session_make(sheet, out);
    paper_sheet_destroy(sheet);
    return status;
}

enum paper_status studio_session_open(const char *path, double budget_bytes,
                                      struct studio_session **out)
{
    struct paper_state *state;
    struct paper_sheet *sheet = NULL;
    *out = NULL;
    enum paper_status status = paper_state_open(path, &state);
    if (status != PAPER_OK)
        return status;
    struct paper_sheet_config config;
    status = paper_state_describe(state, 0, &config);
    if (status == PAPER_OK && !(config.parts & PAPER_PART_SURFACE))
        status = studio_session_failed(PAPER_BAD_FILE, NO_SURFACE, path);
    if (status == PAPER_OK)
        status = paper_state_load(state, 0, false, budget_bytes, &sheet);
    paper_state_close(state);
    return status == PAPER_OK ? session_make(sheet, out) : status;
}

enum paper_status studio_session_find(const char *journal, const char *state,
                                      double budget_bytes, struct paper_journal_found *found,
                                      struct studio_session **out)
{
    struct paper_sheet *sheet;
    *out = NULL;
    enum paper_status status = paper_journal_open(journal, state, budget_bytes, found, &sheet);
    if (status != PAPER_OK)
        return status;
    if (paper_sheet_get_config(sheet)->parts & PAPER_PART_SURFACE) {
        status = session_make(sheet, out);
        if (status == PAPER_OK && paper_history_undone(sheet) > 0) /* nothing of it gets lost */
            (*out)->present = paper_history_done(sheet) + paper_history_undone(sheet);
        return status;
    }
    paper_sheet_destroy(sheet);
    return studio_session_failed(PAPER_BAD_FILE, NO_SURFACE, state ? state : journal);
}

void studio_session_destroy(struct studio_session *s)
{
    if (!s)
        return;
    paper_sheet_destroy(s->sheet);
    studio_selection_free(&s->selection);
    studio_session_change_forget(s);
    if (s->pairs)
        free(s->pairs->at);
    free(s->pairs);
    free(s->samples);
    free(s);
}

struct paper_sheet *studio_session_sheet(struct studio_session *s)
{
    return s->sheet;
}

const struct studio_settings *studio_session_settings(const struct studio_session *s)
{
    return &s->settings;
}

enum paper_status studio_session_set(struct studio_session *s, int setting, double value)
{
    return stage_control_write(&studio_controls[setting], &s->settings, value) == STAGE_OK
               ? PAPER_OK
               : studio_session_failed(PAPER_BAD_ARGUMENT, "%s", stage_error());
}

bool studio_session_busy(const struct studio_session *s)
{
    return s->down;
}

/* ---- time ---- */

bool studio_session_held(const struct studio_session *s)
{
    return (s->held && paper_history_undone(s->sheet) > 0) || s->present >= 0 ||
           s->inserting >= 0;
}

void studio_session_go_on(struct studio_session *s)
{
    if (studio_session_visits(s))
        studio_session_present(s);
    s->wet = s->wet || s->held;
    s->held = false;
}

bool studio_session_wet(const struct studio_session *s)
{
    return s->wet;
}

enum paper_status studio_session_steps(struct studio_session *s, int count, int *done)
{
    enum paper_status status = PAPER_OK;
    int i = 0;
    if (!s->down && !studio_session_held(s))
        status = studio_session_air(s);
    for (; i < count && status == PAPER_OK && !s->down && !studio_session_held(s); i++)
        status = paper_sheet_step(s->sheet);
    if (i > 0 && status == PAPER_OK)
        s->wet = paper_sheet_share(s->sheet) > 0;
    if (done)
        *done = i;
    return status;
}

/* ---- undo: deeds among the operations ---- */

/* The number of operations that are left when the last deed is undone; -1: there is none. */
static int undone_to(const struct studio_session *s)
{
    int left = paper_history_done(s->sheet);
    while (left > 0 && studio_session_part(s, left - 1) != STUDIO_PART_DEED)
        left--;
    if (left == 0)
        return -1;
    left--;
    while (left > 0 && studio_session_part(s, left - 1) == STUDIO_PART_BEFORE)
        left--;
    return s->inserting >= 0 && left < s->inserting ? -1 : left;
}

/* The number of operations that are done when the next deed is redone; -1: there is none. */
static int redone_to(const struct studio_session *s)
{
    int done = paper_history_done(s->sheet);
    const int all = done + paper_history_undone(s->sheet);
    while (done < all && studio_session_part(s, done) != STUDIO_PART_DEED)
        done++;
    if (done == all)
        return -1;
    done++;
    while (done < all && studio_session_part(s, done) == STUDIO_PART_AFTER)
        done++;
    return done;
}

bool studio_session_can_undo(const struct studio_session *s)
{
    return s->down || studio_session_change_waits(s) || undone_to(s) >= 0;
}

bool studio_session_can_redo(const struct studio_session *s)
{
    return !s->down && (redone_to(s) >= 0 || studio_session_change_returns(s));
}

bool studio_session_undo(struct studio_session *s)
{
    if (s->down) {
        studio_session_drop(s);
        return true;
    }
    if (studio_session_change_undo(s))
        return true;
    const int left = undone_to(s);
    if (left < 0)
        return false;
    const int count = paper_history_done(s->sheet) - left;
    paper_history_undo(s->sheet, studio_session_inserted(s) ? 1 : count);
    s->inserted = -1;
    s->held = true;
    studio_session_selection_forget(s);
    s->has_brush = false;
    s->wet = true;
    return true;
}

bool studio_session_redo(struct studio_session *s)
{
    const int done = s->down ? -1 : redone_to(s);
    if (done < 0)
        return studio_session_change_redo(s);
    if (s->changed.state == CHANGE_DONE)
        studio_session_change_forget(s);
    paper_history_redo(s->sheet, done - paper_history_done(s->sheet));
    if (done >= s->present)
        s->present = -1;
    studio_session_selection_forget(s);
    s->has_brush = false;
    s->wet = true;
    return true;
}

/* ---- files ---- */

enum paper_status studio_session_save(struct studio_session *s, const char *path)
{
    return paper_state_save(path, &(struct paper_state_sheet){1, s->sheet}, 1);
}

enum paper_status studio_session_picture(struct studio_session *s, const char *path, int scale)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(s->sheet);
    struct paper_sheet_view view = studio_session_view(s);
    view.scale = scale;
    const size_t count =
        3 * (size_t)config->width * (size_t)config->height * (size_t)scale * (size_t)scale;
    uint16_t *rgb = malloc(count * sizeof *rgb);
    if (!rgb)
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a picture of the sheet");
    enum paper_status status = paper_sheet_view(s->sheet, &view, rgb);
    if (status == PAPER_OK &&
        display_png_write_16(path, scale * config->width, scale * config->height, 3, rgb) !=
            DISPLAY_OK)
        status = studio_session_failed(PAPER_BAD_ARGUMENT, "%s", display_error());
    free(rgb);
    return status;
}

enum paper_status studio_session_script(struct studio_session *s, const char *path)
{
    const enum paper_show show = studio_session_view(s).show;
    return script_session_write(s->sheet, show == PAPER_SHOW_LAYER ? PAPER_SHOW_WET : show,
                                path) == SCRIPT_OK
               ? PAPER_OK
               : studio_session_failed(PAPER_BAD_ARGUMENT, "%s", script_session_error());
}

struct paper_sheet_view studio_session_view(const struct studio_session *s)
{
    static const struct {
        enum paper_show show;
        enum paper_layer layer;
    } shows[] = {[STUDIO_SHOW_COLOR] = {PAPER_SHOW_COLOR, 0},
                 [STUDIO_SHOW_WET] = {PAPER_SHOW_WET, 0},
                 [STUDIO_SHOW_WATER] = {PAPER_SHOW_WATER, 0},
                 [STUDIO_SHOW_RELIEF] = {PAPER_SHOW_COLOR, 0},
                 [STUDIO_SHOW_MASK] = {PAPER_SHOW_LAYER, PAPER_LAYER_RESIST},
                 [STUDIO_SHOW_SWIMMING] = {PAPER_SHOW_LAYER, PAPER_LAYER_SURFACE_PIGMENT},
                 [STUDIO_SHOW_SUNK] = {PAPER_SHOW_LAYER, PAPER_LAYER_INFUSED_PIGMENT},
                 [STUDIO_SHOW_SETTLED] = {PAPER_SHOW_LAYER, PAPER_LAYER_FIXED_PIGMENT}};
    const struct paper_sheet_config *config = paper_sheet_get_config(s->sheet);
    struct paper_sheet_view view = paper_sheet_view_default(config);
    const int show = (int)s->settings.value[STUDIO_SHOW],
              shown = (int)s->settings.value[STUDIO_SHOWN];
    view.show = shows[show].show;
    view.layer = shows[show].layer;
    view.pigment = (shown < config->pigments_count ? shown : config->pigments_count) - 1;
    view.low = 0;
    view.high = 1;
    if (show == STUDIO_SHOW_RELIEF)
        view.light = 4;
    return view;
}
