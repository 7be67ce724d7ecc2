/* read_stages.c - demonstrations in the page: scripts that live, each a process, its picture
 * over its text, and under it a button that starts and stops it and a line that it says.
 *
 * None runs before its button is pressed. It computes only while it is seen; three have
 * processes at a time: of more, the one that was not seen for longest is ended. One that fails,
 * hangs or dies says so in its line, and runs again when its button is pressed.
 *
 * The buttons are children of the page that are drawn, where read_heard.c's are not. */
#include "read_desk.h"

#include <demonstration.h>

enum { STAGES_AT_ONCE = 3 };

struct stage {
    int block; /* of the document's */
    int width, height;
    GtkWidget *strip, *button, *line;
    struct demonstration *run; /* NULL: it does not run */
    GdkTexture *texture;       /* its last picture; NULL: none */
    bool seen;
    struct reader_stage place; /* in the window, while it is seen */
    gint64 seen_us;
};

struct read_stages {
    struct read_desk *desk;
    GPtrArray *all;      /* struct stage */
    struct stage *held;  /* the button that was pressed on it is still down */
    struct stage *keyed; /* keys go to it */
    guint filling, tick;
    gint64 tick_us;
};

struct read_stages *read_stages_create(struct read_desk *d)
{
    struct read_stages *stages = g_new0(struct read_stages, 1);
    stages->desk = d;
    stages->all = g_ptr_array_new();
    return stages;
}

static struct stage *stage_of(const struct read_stages *stages, int block)
{
    for (guint i = 0; i < stages->all->len; i++) {
        struct stage *s = g_ptr_array_index(stages->all, i);
        if (s->block == block)
            return s;
    }
    return NULL;
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
    gtk_button_set_label(GTK_BUTTON(s->button), runs ? _("Stop") : _("Run"));
    desk_name(s->button, runs ? _("Stop the demonstration") : _("Run the demonstration"),
              runs ? _("Stop the demonstration")
                   : _("Run the script below, in a process that reaches no files"));
}

static void stage_stop(struct read_stages *stages, struct stage *s)
{
    demonstration_stop(s->run);
    s->run = NULL;
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
    const struct demonstration_def def = demonstration_def_default(
        block->text ? block->text : "", (size_t)block->bytes, s->width, s->height);
    if (!room_make(stages)) {
        line_set(s, _("Three demonstrations run already: stop one of them."));
        return;
    }
    line_set(s, "");
    if (!demonstration_start(&def, &s->run))
        line_set(s, demonstration_error());
    button_set(s);
    tick_ensure(stages);
}

static void button_clicked(GtkButton *button, struct stage *s)
{
    struct read_stages *stages = g_object_get_data(G_OBJECT(button), "stages");
    if (s->run) {
        stage_stop(stages, s);
        line_set(s, _("Stopped."));
    } else {
        stage_start(stages, s);
    }
    gtk_widget_queue_draw(stages->desk->page);
}

static struct stage *stage_new(struct read_stages *stages, int block)
{
    const struct reader_block *from = &stages->desk->document->blocks[block];
    struct stage *s = g_new0(struct stage, 1);
    s->block = block;
    s->width = from->stage_width;
    s->height = from->stage_height;
    s->strip = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    s->button = gtk_button_new();
    s->line = gtk_label_new("");
    gtk_label_set_ellipsize(GTK_LABEL(s->line), PANGO_ELLIPSIZE_END);
    gtk_label_set_xalign(GTK_LABEL(s->line), 0);
    gtk_widget_set_hexpand(s->line, TRUE);
    gtk_widget_set_valign(s->button, GTK_ALIGN_START);
    gtk_box_append(GTK_BOX(s->strip), s->button);
    gtk_box_append(GTK_BOX(s->strip), s->line);
    g_object_set_data(G_OBJECT(s->button), "stages", stages);
    g_signal_connect(s->button, "clicked", G_CALLBACK(button_clicked), s);
    gtk_widget_set_parent(s->strip, stages->desk->page);
    button_set(s);
    g_ptr_array_add(stages->all, s);
    return s;
}

static void stage_free(struct stage *s)
{
    demonstration_stop(s->run);
    g_clear_object(&s->texture);
    g_free(s);
}

/* ---- all of them ---- */

void read_stages_forget(struct read_desk *d)
{
    struct read_stages *stages = d->stages;
    for (guint i = 0; i < stages->all->len; i++) {
        struct stage *s = g_ptr_array_index(stages->all, i);
        if (d->page)
            gtk_widget_unparent(s->strip);
        stage_free(s);
    }
    g_ptr_array_set_size(stages->all, 0);
    stages->held = stages->keyed = NULL;
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
    g_free(stages);
}

/* ---- what is seen ---- */

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
        if (reader_view_stage(d->view, &shown[i], &place) && !stage_of(stages, place.block))
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

/* Under its picture, as far as the column goes: what it says may be longer than that is
 * wide. */
static void strip_place(const struct read_desk *d, const struct stage *s)
{
    enum { GAP = 4 };
    int least = 0, natural = 0, wide = 0;
    gtk_widget_set_child_visible(s->strip, s->seen);
    if (!s->seen)
        return;
    gtk_widget_measure(s->strip, GTK_ORIENTATION_HORIZONTAL, -1, &wide, &natural, NULL, NULL);
    const double column =
        d->setup.width_px - d->setup.margin_px - d->setup.notes_px - s->place.x;
    wide = MAX(wide, (int)MAX(s->place.width, column));
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
    for (int i = 0; i < count; i++) {
        struct stage *s = reader_view_stage(d->view, &shown[i], &place)
                              ? stage_of(d->stages, place.block)
                              : NULL;
        if (!s)
            continue;
        s->place = place;
        s->seen = place.y < d->setup.height_px &&
                  place.y + place.height + d->setup.stage_strip_px > 0;
        s->seen_us = g_get_monotonic_time();
    }
    for (guint i = 0; i < d->stages->all->len; i++)
        strip_place(d, g_ptr_array_index(d->stages->all, i));
    tick_ensure(d->stages);
}

/* ---- drawing ---- */

static void frame_draw(const struct read_desk *d, GtkSnapshot *snapshot,
                       const graphene_rect_t *box, bool keyed)
{
    const double *c = keyed ? d->colours->link : d->colours->struck;
    const float width = keyed ? 2 : 1;
    const GdkRGBA rgba = {(float)c[0], (float)c[1], (float)c[2], 1};
    GskRoundedRect outline;
    gsk_rounded_rect_init_from_rect(&outline, box, 0);
    gtk_snapshot_append_border(snapshot, &outline, (const float[]){width, width, width, width},
                               (const GdkRGBA[]){rgba, rgba, rgba, rgba});
}

/* Tab has come to it. */
static bool is_focused(const struct read_desk *d, const struct stage *s)
{
    return gtk_widget_has_focus(d->page) && d->focused == d->document->blocks[s->block].at;
}

void read_stages_draw(struct read_desk *d, GtkSnapshot *snapshot)
{
    for (guint i = 0; i < d->stages->all->len; i++) {
        const struct stage *s = g_ptr_array_index(d->stages->all, i);
        const graphene_rect_t box =
            GRAPHENE_RECT_INIT((float)s->place.x, (float)s->place.y, (float)s->place.width,
                               (float)s->place.height);
        if (!s->seen)
            continue;
        if (s->texture)
            gtk_snapshot_append_texture(snapshot, s->texture, &box);
        frame_draw(d, snapshot, &box, d->stages->keyed == s || is_focused(d, s));
        gtk_widget_snapshot_child(d->page, s->strip, snapshot);
    }
}

/* ---- running ---- */

static void picture_take(struct stage *s)
{
    const gsize pitch = 3 * (gsize)s->width;
    GBytes *bytes = g_bytes_new(demonstration_picture(s->run), pitch * (gsize)s->height);
    g_clear_object(&s->texture);
    s->texture = gdk_memory_texture_new(s->width, s->height, GDK_MEMORY_R8G8B8, bytes, pitch);
    g_bytes_unref(bytes);
}

static void stage_look(struct read_stages *stages, struct stage *s, double seconds)
{
    demonstration_frame(s->run, seconds);
    if (demonstration_take(s->run)) {
        picture_take(s);
        gtk_widget_queue_draw(stages->desk->page);
    }
    if (demonstration_ended(s->run)) {
        char *why = g_strdup_printf(_("It has ended: %s"), demonstration_ended(s->run));
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

/* ---- hand and keys ---- */

static struct stage *stage_at(const struct read_stages *stages, double x, double y)
{
    for (guint i = 0; i < stages->all->len; i++) {
        struct stage *s = g_ptr_array_index(stages->all, i);
        if (s->seen && s->run && x >= s->place.x && x < s->place.x + s->place.width &&
            y >= s->place.y && y < s->place.y + s->place.height)
            return s;
    }
    return NULL;
}

static void point(const struct stage *s, enum demonstration_pointer what, double x, double y,
                  double pressure)
{
    const double scale = s->width / s->place.width;
    demonstration_pointer(s->run, what, (x - s->place.x) * scale, (y - s->place.y) * scale,
                          pressure);
}

bool read_stages_press(struct read_desk *d, double x, double y)
{
    struct read_stages *stages = d->stages;
    stages->held = stages->keyed = stage_at(stages, x, y);
    if (!stages->held)
        return false;
    point(stages->held, DEMONSTRATION_DOWN, x, y, 1);
    gtk_widget_queue_draw(d->page);
    return true;
}

bool read_stages_move(struct read_desk *d, double x, double y)
{
    const struct stage *held = d->stages->held, *s = held ? held : stage_at(d->stages, x, y);
    if (s)
        point(s, DEMONSTRATION_MOVE, x, y, held ? 1 : 0);
    return s != NULL;
}

bool read_stages_release(struct read_desk *d, double x, double y)
{
    const struct stage *held = d->stages->held;
    d->stages->held = NULL;
    if (held)
        point(held, DEMONSTRATION_UP, x, y, 0);
    return held != NULL;
}

bool read_stages_holds(const struct read_desk *d)
{
    return d->stages->held != NULL;
}

bool read_stages_key(struct read_desk *d, guint key)
{
    const struct stage *s = d->stages->keyed;
    const char *name = gdk_keyval_name(key);
    if (!s || !s->seen || !name || key == GDK_KEY_Tab || key == GDK_KEY_ISO_Left_Tab)
        return false;
    if (key == GDK_KEY_Escape) {
        d->stages->keyed = NULL;
        gtk_widget_queue_draw(d->page);
    } else {
        demonstration_key(s->run, name);
    }
    return true;
}

/* ---- by keys ---- */

bool read_stages_is(const struct reader_block *block)
{
    return block->kind == READER_LIVE && block->stage_width > 0;
}

bool read_stages_follow(struct read_desk *d, size_t byte)
{
    const struct reader_block *block = reader_document_block(d->document, byte);
    const bool flows = block && block < d->document->blocks + d->document->blocks_count &&
                       block >= d->document->blocks; /* and is no note's */
    struct stage *s = flows && block->at == byte
                          ? stage_of(d->stages, (int)(block - d->document->blocks))
                          : NULL;
    if (!s)
        return false;
    button_clicked(GTK_BUTTON(s->button), s);
    d->stages->keyed = s->run ? s : NULL; /* so that keys are its own at once */
    return true;
}

/* ---- for recorded input ---- */

static struct stage *stage_seen(const struct read_stages *stages, int number)
{
    for (guint i = 0; i < stages->all->len; i++) {
        struct stage *s = g_ptr_array_index(stages->all, i);
        if (s->seen && --number == 0)
            return s;
    }
    return NULL;
}

bool read_stages_button(struct read_desk *d, int number)
{
    struct stage *s = stage_seen(d->stages, number);
    if (s)
        button_clicked(GTK_BUTTON(s->button), s);
    return s != NULL;
}

bool read_stages_waits(struct read_desk *d, int number, long pictures)
{
    const struct stage *s = stage_seen(d->stages, number);
    return s && s->run && demonstration_pictures(s->run) < pictures;
}

char *read_stages_told(struct read_desk *d)
{
    GString *all = g_string_new(NULL);
    for (guint i = 0; i < d->stages->all->len; i++) {
        const struct stage *s = g_ptr_array_index(d->stages->all, i);
        g_string_append_printf(all, "stage%u %s %s %ld %.0f %.0f %.0f %.0f\nline%u %s\n", i + 1,
                               s->seen ? "seen" : "unseen", s->run ? "runs" : "rests",
                               s->run ? demonstration_pictures(s->run) : 0, s->place.x,
                               s->place.y, s->place.width, s->place.height, i + 1,
                               gtk_label_get_text(GTK_LABEL(s->line)));
    }
    return g_string_free(all, FALSE);
}
