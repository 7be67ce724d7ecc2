/* read_stages.c - demonstrations in the page: scripts that live and programs in C/Paris, each a
 * process, its picture over its text, and under it a button that starts and stops it, a line
 * that it says, its controls, and what it prints.
 *
 * None runs before its button is pressed. It computes only while it is seen; three have
 * processes at a time: of more, the one that was not seen for longest is ended. One that fails,
 * hangs or dies says so in its line, and runs again when its button is pressed.
 *
 * The buttons are children of the page that are drawn, where read_heard.c's are not. */
#include "read_stages.h"

#include <math.h>
#include <string.h>

enum { STAGES_AT_ONCE = 3, EDITED_MS = 900 };

struct read_stages *read_stages_create(struct read_desk *d)
{
    struct read_stages *stages = g_new0(struct read_stages, 1);
    stages->desk = d;
    stages->all = g_ptr_array_new();
    stages->again = g_array_new(FALSE, FALSE, sizeof(int));
    stages->edited = g_array_new(FALSE, FALSE, sizeof(int));
    return stages;
}

struct stage *read_stage_of(const struct read_stages *stages, int block)
{
    for (guint i = 0; i < stages->all->len; i++) {
        struct stage *s = g_ptr_array_index(stages->all, i);
        if (s->block == block)
            return s;
    }
    return NULL;
}

bool read_stages_is(const struct reader_block *block)
{
    return block->kind == READER_LIVE && block->stage_width > 0;
}

/* ---- one of them ---- */

static void line_set(struct stage *s, const char *text)
{
    if (g_str_equal(gtk_label_get_text(GTK_LABEL(s->line)), text))
        return;
    gtk_label_set_text(GTK_LABEL(s->line), text);
    gtk_widget_set_tooltip_text(s->line, *text ? text : NULL);
}

static void button_set(struct stage *s)
{
    const bool runs = s->run != NULL;
    char *name = g_strdup_printf(runs ? _("Stop demonstration %s") : _("Run demonstration %s"),
                                 s->called);
    gtk_button_set_label(GTK_BUTTON(s->button), runs ? _("Stop") : _("Run"));
    desk_name(s->button, name,
              runs         ? _("Stop the demonstration")
              : s->program ? _("Compile and run the program below, where it reaches no files")
                           : _("Run the script below, in a process that reaches no files"));
    g_free(name);
}

/* "3, Springs": which of the document's it is, and the heading that it stands under. Owns: the
 * caller frees it. */
static char *called_of(const struct reader_document *d, int block)
{
    enum { LETTERS_MOST = 60 };
    const struct reader_block *heading = NULL;
    int number = 0;
    for (int i = 0; i <= block; i++) {
        number += read_stages_is(&d->blocks[i]);
        if (d->blocks[i].kind == READER_HEADING)
            heading = &d->blocks[i];
    }
    if (!heading || !heading->bytes)
        return g_strdup_printf("%d", number);
    char *whole = g_utf8_make_valid(heading->text, heading->bytes),
         *part = g_utf8_substring(whole, 0, MIN(g_utf8_strlen(whole, -1), LETTERS_MOST)),
         *called = g_strdup_printf("%d, %s", number, part);
    g_free(part);
    g_free(whole);
    return called;
}

static void stage_stop(struct read_stages *stages, struct stage *s)
{
    demonstration_stop(s->run);
    s->run = NULL;
    read_controls_fill(s->controls, NULL);
    if (stages->held == s)
        stages->held = NULL;
    if (stages->keyed == s)
        stages->keyed = NULL;
    button_set(s);
}

/* Room for one more: of those that are not seen the one that was seen longest ago is ended. */
static bool room_make(struct read_stages *stages)
{
    struct stage *oldest = NULL;
    int running = 0;
    for (guint i = 0; i < stages->all->len; i++) {
        struct stage *s = g_ptr_array_index(stages->all, i);
        running += s->run != NULL;
        if (s->run && !s->seen && (!oldest || s->seen_us < oldest->seen_us))
            oldest = s;
    }
    if (running < STAGES_AT_ONCE)
        return true;
    if (!oldest)
        return false;
    stage_stop(stages, oldest);
    line_set(oldest, _("It was ended, for others run."));
    return true;
}

static gboolean tick(GtkWidget *widget, GdkFrameClock *clock, gpointer data);

/* Where one runs that is seen, there are ticks. */
static void tick_ensure(struct read_stages *stages)
{
    for (guint i = 0; i < stages->all->len && !stages->tick; i++) {
        const struct stage *s = g_ptr_array_index(stages->all, i);
        if (!s->run || !s->seen)
            continue;
        stages->tick_us = 0;
        stages->tick = gtk_widget_add_tick_callback(stages->desk->page, tick, stages, NULL);
    }
}

static void stage_start(struct read_stages *stages, struct stage *s)
{
    const struct reader_block *block = &stages->desk->document->blocks[s->block];
    struct demonstration_def def = demonstration_def_default(
        block->text ? block->text : "", (size_t)block->bytes, s->width, s->height);
    def.program = s->program;
    if (!room_make(stages)) {
        line_set(s, _("Three demonstrations run already: stop one of them."));
        return;
    }
    line_set(s, "");
    s->printed_lines = 0;
    s->uncompiled = false;
    if (!demonstration_start(&def, &s->run))
        line_set(s, demonstration_error());
    button_set(s);
    tick_ensure(stages);
}

void read_stage_toggle(struct stage *s)
{
    struct read_stages *stages = s->stages;
    if (s->run) {
        stage_stop(stages, s);
        line_set(s, _("Stopped."));
    } else {
        stage_start(stages, s);
    }
    gtk_widget_queue_draw(stages->desk->page);
}

static void button_clicked(GtkButton *button, struct stage *s)
{
    (void)button;
    read_stage_toggle(s);
}

/* Tab goes through the strip, and from its ends back to the page, where it had come from. */
static gboolean strip_key(GtkEventControllerKey *keys, guint key, guint code,
                          GdkModifierType state, struct stage *s)
{
    struct read_desk *d = s->stages->desk;
    const bool back = key == GDK_KEY_ISO_Left_Tab || (state & GDK_SHIFT_MASK);
    (void)keys;
    (void)code;
    GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(d->window));
    if ((key != GDK_KEY_Tab && key != GDK_KEY_ISO_Left_Tab && key != GDK_KEY_Escape) ||
        (focus && gtk_widget_get_ancestor(focus, GTK_TYPE_POPOVER))) /* a choice's list */
        return FALSE;
    if (key != GDK_KEY_Escape &&
        gtk_widget_child_focus(s->strip, back ? GTK_DIR_TAB_BACKWARD : GTK_DIR_TAB_FORWARD))
        return TRUE;
    d->focused = d->document->blocks[s->block].at;
    gtk_widget_grab_focus(d->page);
    if (key != GDK_KEY_Escape && !back)
        d->step(d, true);
    gtk_widget_queue_draw(d->page);
    return TRUE;
}

/* The button and the line, and under them the controls. */
static void strip_make(struct read_stages *stages, struct stage *s)
{
    GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    GtkEventController *keys = gtk_event_controller_key_new();
    s->strip = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
    s->button = gtk_button_new();
    s->line = gtk_label_new("");
    gtk_label_set_ellipsize(GTK_LABEL(s->line), PANGO_ELLIPSIZE_END);
    gtk_label_set_xalign(GTK_LABEL(s->line), 0);
    gtk_widget_set_hexpand(s->line, TRUE);
    gtk_widget_set_valign(s->button, GTK_ALIGN_START);
    gtk_box_append(GTK_BOX(row), s->button);
    gtk_box_append(GTK_BOX(row), s->line);
    gtk_box_append(GTK_BOX(s->strip), row);
    s->controls = read_controls_create(s->strip, s->called);
    if (s->program) {
        s->printed = read_printed_new(s->called);
        gtk_box_append(GTK_BOX(s->strip), s->printed);
    }
    g_signal_connect(s->button, "clicked", G_CALLBACK(button_clicked), s);
    gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
    g_signal_connect(keys, "key-pressed", G_CALLBACK(strip_key), s);
    gtk_widget_add_controller(s->strip, keys);
    gtk_widget_set_parent(s->strip, stages->desk->page);
}

/* Which of the document's programs a block is, from 0; -1: none. */
static int program_number(const struct reader_document *d, int block)
{
    int number = -1;
    for (int i = 0; i <= block; i++)
        number += d->blocks[i].stage_program;
    return d->blocks[block].stage_program ? number : -1;
}

static struct stage *stage_new(struct read_stages *stages, int block)
{
    const struct reader_block *from = &stages->desk->document->blocks[block];
    struct stage *s = g_new0(struct stage, 1);
    s->block = block;
    s->width = from->stage_width;
    s->height = from->stage_height;
    s->program = from->stage_program;
    s->number = program_number(stages->desk->document, block);
    s->stages = stages;
    s->called = called_of(stages->desk->document, block);
    strip_make(stages, s);
    button_set(s);
    g_ptr_array_add(stages->all, s);
    return s;
}

static void stage_free(struct stage *s)
{
    demonstration_stop(s->run);
    g_clear_object(&s->texture);
    g_clear_pointer(&s->pixels, g_bytes_unref);
    read_controls_destroy(s->controls);
    g_free(s->called);
    g_free(s);
}

/* ---- all of them ---- */

/* Before the document goes. */
static void again_note(struct read_stages *stages)
{
    g_array_set_size(stages->again, 0);
    for (guint i = 0; i < stages->all->len; i++) {
        const struct stage *s = g_ptr_array_index(stages->all, i);
        if (s->program && (s->run || s->uncompiled))
            g_array_append_val(stages->again, s->number);
    }
}

void read_stages_again(struct read_desk *d)
{
    struct read_stages *stages = d->stages;
    for (int block = 0; block < d->document->blocks_count && stages->again->len; block++) {
        const int number = program_number(d->document, block);
        for (guint i = 0; i < stages->again->len && number >= 0; i++)
            if (g_array_index(stages->again, int, i) == number && !read_stage_of(stages, block))
                stage_start(stages, stage_new(stages, block));
    }
    g_array_set_size(stages->again, 0);
}

/* ---- edited programs ---- */

static void edited_forget(struct read_stages *stages)
{
    if (stages->resting)
        g_source_remove(stages->resting);
    stages->resting = 0;
    g_array_set_size(stages->edited, 0);
}

/* Those that still do not run are compiled and run with the text that they have now. */
static gboolean edited_start(gpointer data)
{
    struct read_stages *stages = data;
    const struct reader_document *d = stages->desk->document;
    stages->resting = 0;
    for (int block = 0; block < d->blocks_count && stages->edited->len; block++) {
        const int number = program_number(d, block);
        for (guint i = 0; i < stages->edited->len && number >= 0; i++) {
            if (g_array_index(stages->edited, int, i) != number)
                continue;
            struct stage *s = read_stage_of(stages, block);
            if (!s)
                s = stage_new(stages, block);
            if (!s->run)
                stage_start(stages, s);
        }
    }
    g_array_set_size(stages->edited, 0);
    return G_SOURCE_REMOVE;
}

/* Its text is another: it ends, and one that was running, or was not compiled, is compiled when
 * the hand rests. */
static void edited_note(struct read_stages *stages, const struct stage *s)
{
    bool known = false;
    for (guint i = 0; i < stages->edited->len; i++)
        known = known || g_array_index(stages->edited, int, i) == s->number;
    if (s->program && (s->run || s->uncompiled) && !known)
        g_array_append_val(stages->edited, s->number);
}

/* Any edit: there is time yet. */
static void edited_wait(struct read_stages *stages)
{
    if (!stages->edited->len)
        return;
    if (stages->resting)
        g_source_remove(stages->resting);
    stages->resting = g_timeout_add(EDITED_MS, edited_start, stages);
}

void read_stages_forget(struct read_desk *d)
{
    struct read_stages *stages = d->stages;
    again_note(stages);
    edited_forget(stages);
    for (guint i = 0; i < stages->all->len; i++) {
        struct stage *s = g_ptr_array_index(stages->all, i);
        if (d->page)
            gtk_widget_unparent(s->strip);
        stage_free(s);
    }
    g_ptr_array_set_size(stages->all, 0);
    stages->held = stages->keyed = NULL;
}

/* The script of that number in a document; -1: there is none. */
static int live_of(const struct reader_document *d, int number)
{
    for (int i = 0; i < d->blocks_count; i++)
        if (read_stages_is(&d->blocks[i]) && number-- == 0)
            return i;
    return -1;
}

static int live_number(const struct reader_document *d, int block)
{
    int number = 0;
    for (int i = 0; i < block; i++)
        number += read_stages_is(&d->blocks[i]);
    return number;
}

/* Its script is other: it ends. */
static void edited_end(struct read_desk *d, guint i)
{
    struct read_stages *stages = d->stages;
    struct stage *s = g_ptr_array_index(stages->all, i);
    edited_note(stages, s);
    stages->held = stages->held == s ? NULL : stages->held;
    stages->keyed = stages->keyed == s ? NULL : stages->keyed;
    if (d->page)
        gtk_widget_unparent(s->strip);
    g_ptr_array_remove_index(stages->all, i);
    stage_free(s);
}

void read_stages_edited(struct read_desk *d, int block)
{
    struct read_stages *stages = d->stages;
    for (guint i = stages->all->len; i > 0; i--)
        if (((const struct stage *)g_ptr_array_index(stages->all, i - 1))->block == block)
            edited_end(d, i - 1);
    edited_wait(stages);
}

void read_stages_follow_document(struct read_desk *d, const struct reader_document *before)
{
    struct read_stages *stages = d->stages;
    for (guint i = stages->all->len; i > 0; i--) {
        struct stage *s = g_ptr_array_index(stages->all, i - 1);
        const int now = live_of(d->document, live_number(before, s->block));
        if (now >= 0 &&
            strcmp(before->blocks[s->block].text, d->document->blocks[now].text) == 0) {
            s->block = now;
            s->number = program_number(d->document, now);
            continue;
        }
        edited_end(d, i - 1);
    }
    edited_wait(stages);
}

void read_stages_finish(struct read_desk *d)
{
    struct read_stages *stages = d->stages;
    if (!stages)
        return;
    if (stages->filling)
        g_source_remove(stages->filling);
    if (stages->tick && d->page)
        gtk_widget_remove_tick_callback(d->page, stages->tick);
    stages->filling = stages->tick = 0;
    read_stages_forget(d);
}

void read_stages_destroy(struct read_stages *stages)
{
    g_ptr_array_unref(stages->all);
    g_array_unref(stages->again);
    g_array_unref(stages->edited);
    g_free(stages);
}

/* ---- what is seen ---- */

/* How wide its strip may be: as far as the column goes. */
static double strip_px(const struct stage *s)
{
    return fmax(s->place.width, s->place.right - s->place.x);
}

/* Of its controls, and of what it has printed. */
static int more_px(const struct stage *s)
{
    return read_controls_height(s->controls, (int)strip_px(s)) + read_printed_height(s);
}

/* There is room in the page for those, and no more. */
static void room_ensure(struct read_desk *d, struct stage *s)
{
    if (reader_view_stage_room(d->view, s->block, more_px(s)) != READER_OK)
        d->say(d, reader_error());
    d->changed(d);
}

/* Strips for those that are seen now. */
static gboolean fill(gpointer data)
{
    struct read_stages *stages = data;
    struct read_desk *d = stages->desk;
    const struct reader_shown *shown;
    struct reader_stage place;
    int count = 0;
    stages->filling = 0;
    if (!d->page || !d->view || reader_view_look(d->view, &shown, &count) != READER_OK)
        return G_SOURCE_REMOVE;
    for (int i = 0; i < count; i++)
        for (int k = 0; reader_view_stage(d->view, &shown[i], k, &place); k++)
            if (!read_stage_of(stages, place.block))
                stage_new(stages, place.block);
    gtk_widget_queue_allocate(d->page);
    return G_SOURCE_REMOVE;
}

void read_stages_changed(struct read_desk *d)
{
    if (!d->stages->filling)
        d->stages->filling = g_idle_add_full(G_PRIORITY_DEFAULT, fill, d->stages, NULL);
    if (d->stages->all->len)
        gtk_widget_queue_allocate(d->page);
}

/* Under its picture: what it says may be longer than that is wide. */
static void strip_place(const struct stage *s)
{
    enum { GAP = 4 };
    int least = 0, natural = 0, wide = 0;
    gtk_widget_set_child_visible(s->strip, s->seen);
    if (!s->seen)
        return;
    read_controls_height(s->controls, (int)strip_px(s)); /* in this column */
    gtk_widget_measure(s->strip, GTK_ORIENTATION_HORIZONTAL, -1, &wide, &natural, NULL, NULL);
    wide = MAX(wide, (int)strip_px(s));
    gtk_widget_measure(s->strip, GTK_ORIENTATION_VERTICAL, wide, &least, &natural, NULL, NULL);
    const GtkAllocation box = {(int)s->place.x, (int)(s->place.y + s->place.height) + GAP, wide,
                               least};
    gtk_widget_size_allocate(s->strip, &box, -1);
}

void read_stages_place(struct read_desk *d)
{
    const struct reader_shown *shown;
    struct reader_stage place;
    int count = 0;
    if (!d->view || reader_view_look(d->view, &shown, &count) != READER_OK)
        count = 0;
    for (guint i = 0; i < d->stages->all->len; i++)
        ((struct stage *)g_ptr_array_index(d->stages->all, i))->seen = false;
    for (int i = 0; i < count; i++)
        for (int k = 0; reader_view_stage(d->view, &shown[i], k, &place); k++) {
            struct stage *s = read_stage_of(d->stages, place.block);
            if (!s)
                continue;
            s->place = place;
            s->seen = place.y < d->setup.height_px &&
                      place.y + place.height + d->setup.stage_strip_px + more_px(s) > 0;
            s->seen_us = g_get_monotonic_time();
        }
    for (guint i = 0; i < d->stages->all->len; i++)
        strip_place(g_ptr_array_index(d->stages->all, i));
    tick_ensure(d->stages);
}

/* ---- running ---- */

/* False: it is the same picture as before, and nothing is drawn for it. */
static bool picture_take(struct stage *s)
{
    const gsize pitch = 3 * (gsize)s->width, size = pitch * (gsize)s->height;
    const uint8_t *picture = demonstration_picture(s->run);
    if (s->pixels && memcmp(g_bytes_get_data(s->pixels, NULL), picture, size) == 0)
        return false;
    g_clear_pointer(&s->pixels, g_bytes_unref);
    g_clear_object(&s->texture);
    s->pixels = g_bytes_new(picture, size);
    s->texture =
        gdk_memory_texture_new(s->width, s->height, GDK_MEMORY_R8G8B8, s->pixels, pitch);
    s->textures++;
    return true;
}

static void stage_look(struct read_stages *stages, struct stage *s, double seconds)
{
    demonstration_frame(s->run, seconds);
    if (demonstration_take(s->run)) {
        if (demonstration_pictures(s->run) == 1) { /* all that it has declared is here */
            read_controls_fill(s->controls, s->run);
            room_ensure(stages->desk, s);
        }
        if (picture_take(s))
            gtk_widget_queue_draw(stages->desk->page);
    }
    if (read_printed_fill(s))
        room_ensure(stages->desk, s);
    if (demonstration_ended(s->run)) {
        char *why = g_strdup_printf(_("It has ended: %s"), demonstration_ended(s->run));
        s->uncompiled = g_str_has_prefix(demonstration_ended(s->run), DEMONSTRATION_UNCOMPILED);
        stage_stop(stages, s);
        line_set(s, why);
        g_free(why);
    } else {
        line_set(s, demonstration_said(s->run));
    }
}

static gboolean tick(GtkWidget *widget, GdkFrameClock *clock, gpointer data)
{
    struct read_stages *stages = data;
    const gint64 now_us = gdk_frame_clock_get_frame_time(clock);
    const double seconds =
        stages->tick_us ? CLAMP((double)(now_us - stages->tick_us) * 1e-6, 0, 0.1) : 0;
    bool runs = false;
    (void)widget;
    stages->tick_us = now_us;
    for (guint i = 0; i < stages->all->len; i++) {
        struct stage *s = g_ptr_array_index(stages->all, i);
        if (s->run && s->seen)
            stage_look(stages, s, seconds);
        runs = runs || (s->run && s->seen);
    }
    if (!runs)
        stages->tick = 0;
    return runs ? G_SOURCE_CONTINUE : G_SOURCE_REMOVE;
}
