/* read_stages_hand.c - what a hand, keys and recorded input do to demonstrations in the
 * page. */
#include "read_stages.h"

/* ---- hand and keys ---- */

static struct stage *stage_at(const struct read_stages *stages, double x, double y)
{
    for (guint i = 0; i < stages->all->len; i++) {
        struct stage *s = g_ptr_array_index(stages->all, i);
        if (s->seen && s->run && !s->program && x >= s->place.x &&
            x < s->place.x + s->place.width && y >= s->place.y &&
            y < s->place.y + s->place.height)
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
    point(stages->held, DEMONSTRATION_DOWN, x, y, d->pressure);
    gtk_widget_queue_draw(d->page);
    return true;
}

bool read_stages_move(struct read_desk *d, double x, double y)
{
    const struct stage *held = d->stages->held, *s = held ? held : stage_at(d->stages, x, y);
    if (s)
        point(s, DEMONSTRATION_MOVE, x, y, held ? d->pressure : 0);
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
    if (key == GDK_KEY_Tab || key == GDK_KEY_ISO_Left_Tab) { /* to what is next */
        d->stages->keyed = NULL;
        return false;
    }
    if (!s || !s->seen || !name)
        return false;
    if (key == GDK_KEY_Escape) {
        d->stages->keyed = NULL;
        gtk_widget_queue_draw(d->page);
    } else {
        demonstration_key(s->run, true, name);
    }
    return true;
}

void read_stages_key_up(struct read_desk *d, guint key)
{
    const struct stage *s = d->stages->keyed;
    const char *name = gdk_keyval_name(key);
    if (s && s->run && name && key != GDK_KEY_Escape)
        demonstration_key(s->run, false, name);
}

bool read_stages_types(const struct read_desk *d)
{
    const GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(d->window));
    bool types = false;
    for (guint i = 0; i < d->stages->all->len && !types; i++)
        types = read_controls_has(
            ((const struct stage *)g_ptr_array_index(d->stages->all, i))->controls, focus);
    return types;
}

/* ---- by keys ---- */

/* The one whose block begins there; NULL: none does. */
static struct stage *stage_beginning(const struct read_desk *d, size_t byte)
{
    const struct reader_block *block =
        byte == G_MAXSIZE ? NULL : reader_document_block(d->document, byte);
    const bool flows = block && block < d->document->blocks + d->document->blocks_count &&
                       block >= d->document->blocks; /* and is no note's */
    return flows && block->at == byte
               ? read_stage_of(d->stages, (int)(block - d->document->blocks))
               : NULL;
}

bool read_stages_enter(struct read_desk *d, size_t byte)
{
    const struct stage *s = stage_beginning(d, byte);
    return s && s->seen && s->run && read_controls_enter(s->controls);
}

bool read_stages_follow(struct read_desk *d, size_t byte)
{
    struct stage *s = stage_beginning(d, byte);
    if (!s)
        return false;
    read_stage_toggle(s);
    d->stages->keyed = s->run && !s->program ? s : NULL; /* so that keys are its own at once */
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
        read_stage_toggle(s);
    return s != NULL;
}

bool read_stages_set(struct read_desk *d, int number, int control, double value)
{
    const struct stage *s = stage_seen(d->stages, number);
    return s && read_controls_type(s->controls, control, value);
}

bool read_stages_waits(struct read_desk *d, int number, long pictures)
{
    const struct stage *s = stage_seen(d->stages, number);
    if (d->stages->resting) /* it may be compiled soon */
        return true;
    return s && s->run && demonstration_pictures(s->run) < pictures;
}

char *read_stages_told(struct read_desk *d)
{
    GString *all = g_string_new(NULL);
    for (guint i = 0; i < d->stages->all->len; i++) {
        const struct stage *s = g_ptr_array_index(d->stages->all, i);
        g_string_append_printf(all, "stage%u %s %s %ld %.0f %.0f %.0f %.0f %ld\nline%u %s\n",
                               i + 1, s->seen ? "seen" : "unseen", s->run ? "runs" : "rests",
                               s->run ? demonstration_pictures(s->run) : 0, s->place.x,
                               s->place.y, s->place.width, s->place.height, s->textures, i + 1,
                               gtk_label_get_text(GTK_LABEL(s->line)));
        read_controls_tell(s->controls, all);
        read_printed_tell(s, i + 1, all);
    }
    return g_string_free(all, FALSE);
}
