/* stage.c - see stage.h. */
#include "stage_internal.h"

#include <text.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct stage_def stage_def_default(void)
{
    return (struct stage_def){.theme = "light", .step_s = 1.0 / 240};
}

enum { OWN_CONTROLS = 6 };

/* ---- the session ---- */

/* Records an action, from the first frame on. */
static void deed_add(struct stage *s, struct stage_deed deed)
{
    deed.step = s->clock.steps_count;
    if (s->began && !s->forgets)
        stage_session_add(&s->session, &deed);
}

static void deed_set_add(struct stage *s, int control, double value)
{
    deed_add(s,
             (struct stage_deed){.kind = STAGE_DEED_SET, .control = control, .value = value});
}

/* ---- controls ---- */

static double own_read(void *stage, int index)
{
    const struct stage_settings *s = &((struct stage *)stage)->settings;
    const double values[OWN_CONTROLS] = {s->rate,    s->skins, s->skin_every_s,
                                         s->skin_of, s->grid,  s->shadow};
    return values[index];
}

static unsigned own_write(void *of, int index, double value)
{
    struct stage *stage = of;
    struct stage_settings *s = &stage->settings;
    double *const values[OWN_CONTROLS] = {&s->rate,    &s->skins, &s->skin_every_s,
                                          &s->skin_of, &s->grid,  &s->shadow};
    *values[index] = value;
    frame_clock_rate_set(&stage->clock, s->rate);
    if (values[index] == &s->skins || values[index] == &s->skin_every_s)
        stage_skins_drop(stage);
    deed_set_add(stage, index, value);
    return STAGE_OK;
}

static const struct control own_rows[OWN_CONTROLS] = {
    {"rate", "", 0.01, 10, 1, CONTROL_LOGARITHMIC, NULL,
     "simulated seconds in one second: below 1 slow motion", own_read, own_write, 0},
    {"skins", "", 0, STAGE_SKINS_MAX, 0, CONTROL_LINEAR, NULL,
     "how many earlier moments are seen behind the present", own_read, own_write, 1},
    {"skin_every", "s", 0.01, 2, 0.1, CONTROL_LOGARITHMIC, NULL,
     "how far these moments are apart", own_read, own_write, 2},
    {"skin_of", "", 0, 1, 0, CONTROL_CHOICE, "letters all", "what is seen of them", own_read,
     own_write, 3},
    {"grid", "", 0, 1, 0, CONTROL_SWITCH, NULL, "lines a unit of the world apart", own_read,
     own_write, 4},
    {"shadow", "", 0, 1, 0, CONTROL_SWITCH, NULL, "letters throw a shadow on what is behind",
     own_read, own_write, 5}};

static const struct control *actors_row(const struct stage *s, int index)
{
    return &s->actors_rows[index];
}

/* The actor's rows are wrapped, so that all rows take the stage as their object. */
static double actors_read(void *stage, int index)
{
    const struct stage *s = stage;
    return control_read(actors_row(s, index), s->actor.self);
}

static unsigned actors_write(void *stage, int index, double value)
{
    struct stage *s = stage;
    enum stage_status status = stage_control_write(actors_row(s, index), s->actor.self, value);
    if (status == STAGE_OK)
        deed_set_add(s, OWN_CONTROLS + index, value);
    return status;
}

static enum stage_status controls_make(struct stage *s)
{
    int count = 0;
    if (s->actor.kind->controls)
        s->actors_rows = s->actor.kind->controls(s->actor.self, &count);
    s->controls = malloc(((size_t)count + OWN_CONTROLS) * sizeof *s->controls);
    if (!s->controls)
        return stage_fail(STAGE_NO_MEMORY, "no memory for a stage");
    memcpy(s->controls, own_rows, sizeof own_rows);
    for (int i = 0; i < count; i++) {
        struct control row = s->actors_rows[i];
        row.at = i;
        row.read = actors_read;
        row.write = actors_write;
        s->controls[OWN_CONTROLS + i] = row;
    }
    s->controls_count = OWN_CONTROLS + count;
    return STAGE_OK;
}

const struct control *stage_controls(struct stage *s, int *count)
{
    *count = s->controls_count;
    return s->controls;
}

enum stage_status stage_set(struct stage *s, const char *assignment)
{
    char name[64];
    const char *equals = strchr(assignment, '=');
    double value;
    if (!equals || equals == assignment || equals - assignment >= (ptrdiff_t)sizeof name)
        return stage_fail(STAGE_BAD_ARGUMENT, "a control is set by NAME=VALUE (got '%.60s')",
                          assignment);
    memcpy(name, assignment, (size_t)(equals - assignment));
    name[equals - assignment] = '\0';
    const struct control *row = stage_control_find(s->controls, s->controls_count, name);
    if (!row)
        return STAGE_BAD_ARGUMENT;
    enum stage_status status = stage_control_parse(row, equals + 1, &value);
    return status == STAGE_OK ? stage_control_write(row, s, value) : status;
}

struct stage_actor stage_actor(const struct stage *s)
{
    return s->actor;
}

/* ---- time ---- */

struct frame_clock *stage_clock(struct stage *s)
{
    return &s->clock;
}

static enum stage_status mark_keep(const struct stage *s, struct stage_saved *mark)
{
    *mark = (struct stage_saved){.settings = s->settings};
    enum stage_status status = STAGE_OK;
    if (s->actor.kind->keep)
        status = s->actor.kind->keep(s->actor.self, &mark->actor);
    mark->kept = status == STAGE_OK;
    return status;
}

static void mark_forget(const struct stage *s, struct stage_saved *mark)
{
    if (mark->actor)
        s->actor.kind->forget(mark->actor);
    *mark = (struct stage_saved){0};
}

static enum stage_status mark_restore(struct stage *s, const struct stage_saved *mark)
{
    s->settings = mark->settings;
    frame_clock_rate_set(&s->clock, s->settings.rate);
    s->handed = false;
    stage_skins_drop(s);
    return mark->actor ? s->actor.kind->restore(s->actor.self, mark->actor) : STAGE_OK;
}

/* Keeps the state for resets: that before the first frame, when all parameters are set. */
static enum stage_status beginning_keep(struct stage *s)
{
    return s->beginning.kept ? STAGE_OK : mark_keep(s, &s->beginning);
}

/* Passes a pointer action to the actor, in world coordinates. */
static bool hand_do(struct stage *s, const struct stage_event *event)
{
    if (!s->actor.kind->event || (event->kind != STAGE_POINTER_DOWN && !s->handed))
        return false;
    bool taken = s->actor.kind->event(s->actor.self, event);
    if (taken || event->kind != STAGE_POINTER_DOWN)
        deed_add(s, (struct stage_deed){.kind = STAGE_DEED_HAND, .event = *event});
    if (event->kind == STAGE_POINTER_DOWN)
        s->handed = taken;
    else if (event->kind != STAGE_POINTER_MOVE)
        s->handed = false;
    return taken;
}

/* Loads a file; a mark was set before it. */
static enum stage_status load_do(struct stage *s, const char *path)
{
    enum stage_status status = s->actor.kind->load(s->actor.self, path);
    if (status == STAGE_OK && s->began)
        stage_session_add_load(&s->session, s->clock.steps_count, path);
    s->handed = false;
    stage_skins_drop(s);
    return status;
}

/* The same, of a session. The file may have changed since the session was read. */
static enum stage_status load_again(struct stage *s, const struct stage_file *file, int line)
{
    enum stage_status status = stage_session_file_check(file, "the session", line);
    if (status == STAGE_OK && !s->actor.kind->load)
        status = stage_fail(STAGE_BAD_FILE, "the session:%d: %s has no files", line,
                            s->actor.kind->name);
    return status == STAGE_OK ? load_do(s, file->path) : status;
}

enum stage_status stage_text_check(const struct stage *s, const char *words)
{
    const size_t length = strlen(words);
    bool is_text = length > 0 && font_utf8_damaged(words, length) == 0;
    for (const char *c = words; *c; c++)
        is_text =
            is_text && ((unsigned char)*c >= ' ' || *c == '\n' || *c == '\t') && *c != 0x7f;
    if (!is_text || length > STAGE_TEXT_BYTES)
        return stage_fail(STAGE_BAD_ARGUMENT,
                          "a stage's text is UTF-8, 1 to %d bytes, without control characters",
                          STAGE_TEXT_BYTES);
    return s->actor.kind->text
               ? STAGE_OK
               : stage_fail(STAGE_BAD_ARGUMENT, "%s has no text", s->actor.kind->name);
}

/* A mark was set before it. */
static enum stage_status text_do(struct stage *s, const char *words)
{
    enum stage_status status = stage_text_check(s, words);
    if (status == STAGE_OK)
        status = s->actor.kind->text(s->actor.self, words);
    if (status != STAGE_OK)
        return status;
    if (s->began)
        stage_session_add_text(&s->session, s->clock.steps_count, words);
    s->handed = false;
    stage_skins_drop(s);
    stage_view_grow(s);
    return STAGE_OK;
}

/* Replays the actions that are due before the next step. Errors: those of loading. */
static enum stage_status replay_do(struct stage *s)
{
    const struct stage_session *r = &s->replay;
    enum stage_status status = STAGE_OK;
    for (; status == STAGE_OK && s->replayed_count < r->count; s->replayed_count++) {
        const struct stage_deed *d = &r->deeds[s->replayed_count];
        if (d->step > s->clock.steps_count)
            return STAGE_OK;
        switch (d->kind) {
        case STAGE_DEED_HAND:
            hand_do(s, &d->event);
            break;
        case STAGE_DEED_SET:
            stage_control_write(&s->controls[d->control], s, d->value);
            break;
        case STAGE_DEED_LOAD:
            status = load_again(s, &r->files[d->file], d->line);
            break;
        case STAGE_DEED_TEXT:
            if (text_do(s, r->texts[d->file]) != STAGE_OK)
                status = stage_fail(STAGE_BAD_FILE, "the session:%d: %.300s", d->line,
                                    stage_error());
            break;
        case STAGE_DEED_MARK:
            stage_mark(s);
            break;
        case STAGE_DEED_DROP:
            stage_mark_drop(s);
            break;
        case STAGE_DEED_UNDO:
            stage_undo(s);
            break;
        case STAGE_DEED_RESET:
            stage_reset(s);
            break;
        }
    }
    return status;
}

/* The clock and the session begin. Errors: a session of another beginning. */
static enum stage_status begin(struct stage *s, double now_s)
{
    s->clock.now_s = now_s;
    s->began = true;
    if (s->actor.kind->digest)
        s->session.begin = s->actor.kind->digest(s->actor.self);
    if (!s->replay.begin || s->replay.begin == s->session.begin)
        return STAGE_OK;
    return stage_fail(STAGE_BAD_FILE,
                      "the session began with other words, another font or other files: "
                      "replay it with the same options");
}

enum stage_status stage_frame(struct stage *s, double now_s, int *steps)
{
    enum stage_status status = beginning_keep(s);
    if (status == STAGE_OK && !s->began)
        status = begin(s, now_s);
    int due = frame_clock_advance(&s->clock, now_s);
    if (steps)
        *steps = due;
    int64_t last = s->clock.steps_count;
    for (int i = 0; i < due && status == STAGE_OK; i++) {
        s->clock.steps_count = last - due + i;
        status = replay_do(s);
        stage_skin_take(s);
        if (status == STAGE_OK)
            status = s->actor.kind->step(s->actor.self, s->clock.step_s);
    }
    s->clock.steps_count = last;
    if (s->session_file)
        stage_session_file_add(s->session_file, &s->session, s->controls, last);
    return status;
}

/* ---- hands ---- */

static const double near_px = 14;

bool stage_hand(struct stage *s, enum stage_event_kind kind, double x_px, double y_px,
                double pressure, int button, unsigned modifiers)
{
    struct stage_event event = {
        .kind = kind, .pressure = pressure, .button = button, .modifiers = modifiers};
    if (!s->actor.kind->event || s->view.scale == 0 ||
        (kind != STAGE_POINTER_DOWN && !s->handed))
        return false;
    stage_view_to_world(s->view, x_px, y_px, &event.x, &event.y);
    event.near = near_px * s->px / s->view.scale;
    return hand_do(s, &event);
}

/* ---- going back ---- */

static void mark_push(struct stage *s, struct stage_saved mark)
{
    if (s->marks_count == STAGE_UNDO_MAX) {
        mark_forget(s, &s->marks[0]);
        memmove(s->marks, s->marks + 1, (STAGE_UNDO_MAX - 1) * sizeof *s->marks);
        s->marks_count--;
    }
    s->marks[s->marks_count++] = mark;
}

enum stage_status stage_mark(struct stage *s)
{
    struct stage_saved mark;
    enum stage_status status = mark_keep(s, &mark);
    if (status != STAGE_OK)
        return status;
    mark_push(s, mark);
    deed_add(s, (struct stage_deed){.kind = STAGE_DEED_MARK});
    return STAGE_OK;
}

bool stage_undo(struct stage *s)
{
    if (!s->marks_count)
        return false;
    struct stage_saved mark = s->marks[--s->marks_count];
    deed_add(s, (struct stage_deed){.kind = STAGE_DEED_UNDO});
    bool done = mark_restore(s, &mark) == STAGE_OK;
    mark_forget(s, &mark);
    return done;
}

void stage_mark_drop(struct stage *s)
{
    if (!s->marks_count)
        return;
    mark_forget(s, &s->marks[--s->marks_count]);
    deed_add(s, (struct stage_deed){.kind = STAGE_DEED_DROP});
}

enum stage_status stage_reset(struct stage *s)
{
    struct stage_saved before;
    enum stage_status status = beginning_keep(s);
    if (status == STAGE_OK)
        status = mark_keep(s, &before);
    if (status != STAGE_OK)
        return status;
    mark_push(s, before);
    deed_add(s, (struct stage_deed){.kind = STAGE_DEED_RESET});
    return mark_restore(s, &s->beginning);
}

enum stage_status stage_save(struct stage *s, const char *path)
{
    if (!s->actor.kind->save)
        return stage_fail(STAGE_BAD_ARGUMENT, "%s: %s has no files", path, s->actor.kind->name);
    return s->actor.kind->save(s->actor.self, path);
}

enum stage_status stage_load(struct stage *s, const char *path)
{
    if (!s->actor.kind->load)
        return stage_fail(STAGE_BAD_ARGUMENT, "%s: %s has no files", path, s->actor.kind->name);
    enum stage_status status = stage_mark(s);
    if (status != STAGE_OK)
        return status;
    status = load_do(s, path);
    if (status != STAGE_OK)
        stage_mark_drop(s);
    return status;
}

enum stage_status stage_text(struct stage *s, const char *words)
{
    enum stage_status status = stage_mark(s);
    if (status != STAGE_OK)
        return status;
    status = text_do(s, words);
    if (status != STAGE_OK)
        stage_mark_drop(s);
    return status;
}

enum stage_status stage_session_save(struct stage *s, const char *path)
{
    if (s->forgets)
        return stage_fail(STAGE_BAD_ARGUMENT, "%s: this stage keeps no session", path);
    s->session.end = s->clock.steps_count;
    return stage_session_write(&s->session, s->controls, path);
}

enum stage_status stage_session_follow(struct stage *s, const char *path)
{
    return stage_session_file_open(path, &s->session_file);
}

enum stage_status stage_session_end(struct stage *s)
{
    struct stage_session_file *file = s->session_file;
    s->session_file = NULL;
    s->session.end = s->clock.steps_count;
    return file ? stage_session_file_close(file, &s->session, s->controls) : STAGE_OK;
}

const char *stage_session_said(struct stage *s)
{
    return s->session_file ? stage_session_file_said(s->session_file) : NULL;
}

enum stage_status stage_session_replay(struct stage *s, const char *path)
{
    struct stage_session read;
    enum stage_status status = stage_session_read(path, s->controls, s->controls_count, &read);
    if (status != STAGE_OK)
        return status;
    stage_session_finish(&s->replay);
    s->replay = read;
    s->replayed_count = 0;
    return STAGE_OK;
}

double stage_replay_seconds(const struct stage *s)
{
    return stage_session_seconds(&s->replay, s->settings.rate, s->clock.step_s, 0);
}

/* ---- a stage ---- */

void stage_destroy(struct stage *s)
{
    if (!s)
        return;
    for (int i = 0; i < s->marks_count; i++)
        mark_forget(s, &s->marks[i]);
    mark_forget(s, &s->beginning);
    stage_session_end(s);
    stage_session_finish(&s->session);
    stage_session_finish(&s->replay);
    for (int i = 0; i < STAGE_SKINS_MAX; i++)
        stage_draw_finish(&s->skins[i]);
    stage_draw_finish(&s->own);
    if (s->actor.kind->destroy)
        s->actor.kind->destroy(s->actor.self);
    free(s->controls);
    free(s);
}

enum stage_status stage_create(const struct stage_def *def, struct stage **out)
{
    *out = NULL;
    struct stage *s = calloc(1, sizeof *s);
    if (!s) {
        def->actor.kind->destroy(def->actor.self);
        return stage_fail(STAGE_NO_MEMORY, "no memory for a stage");
    }
    s->actor = def->actor;
    s->forgets = def->forgets;
    s->clock = frame_clock_begin(def->step_s, 0);
    for (int i = 0; i < OWN_CONTROLS; i++)
        own_write(s, i, own_rows[i].usual);
    enum stage_status status = stage_theme_open(def->theme, &s->theme);
    if (status == STAGE_OK)
        status = controls_make(s);
    if (status == STAGE_OK)
        *out = s;
    else
        stage_destroy(s);
    return status;
}
