/* desk_springs.c - springy type in the window: taken by a letter, thrown, and let into the
 * paper where it comes to rest. Until then it is a stencil, as type that is typed. */
#include "desk.h"

#include "studio_springs.h"

/* What a hand does with it. Several may come between two pictures, each with its own time. */
struct deed {
    double time_s, x, y;
    bool ends; /* it is let go */
};

struct desk_springs {
    struct studio_springs *springs;
    GArray *deeds;          /* struct deed, which the next picture does */
    bool held;              /* a hand has it, after those */
    double deed_s, since_s; /* the time of the last one done, and what has gone by since */
    guint tick;
    void (*rests)(struct desk *d); /* then it is let into the paper */
    gint64 seen_us;                /* the frame clock's time of the last picture */
};

#define STILL_MOST 0.1 /* seconds at the most that go by between two deeds and were not seen */

/* False: it cannot be drawn; said. */
static bool drawn(struct desk *d, struct paper_screen *screen, int *x, int *y)
{
    const bool good = studio_springs_screen(d->springs->springs, screen, x, y) == PAPER_OK;
    if (!good)
        desk_say(d, studio_session_error());
    return good;
}

/* The stencil moves also while the paper is busy. */
static void stencil_show(struct desk *d)
{
    struct paper_screen screen;
    int x = 0, y = 0;
    if (drawn(d, &screen, &x, &y))
        studio_paper_show_now(d->paper, &(struct studio_shown){x, y, screen.width_px,
                                                               screen.height_px, screen.gray});
}

static void step(struct desk_springs *s, double seconds)
{
    studio_springs_step(s->springs, seconds);
    s->since_s += seconds;
}

/* The deeds, each at its time, and what time is left: also of a throw between two pictures the
 * springs know how fast it was. */
static void time_go(struct desk_springs *s, double seconds)
{
    for (guint i = 0; i < s->deeds->len; i++) {
        const struct deed *deed = &g_array_index(s->deeds, struct deed, i);
        const double before = CLAMP(deed->time_s - s->deed_s - s->since_s, 0, STILL_MOST);
        step(s, before);
        seconds -= before;
        if (deed->ends)
            studio_springs_let_go(s->springs);
        else
            studio_springs_move(s->springs, deed->x, deed->y);
        s->deed_s = deed->time_s;
        s->since_s = 0;
    }
    g_array_set_size(s->deeds, 0);
    if (seconds > 0)
        step(s, seconds);
}

static gboolean tick(GtkWidget *canvas, GdkFrameClock *clock, gpointer data)
{
    struct desk *d = data;
    struct desk_springs *s = d->springs;
    const gint64 now_us = gdk_frame_clock_get_frame_time(clock);
    (void)canvas;
    time_go(s, s->seen_us ? (double)(now_us - s->seen_us) * 1e-6 : 0);
    s->seen_us = now_us;
    if (studio_springs_rests(s->springs)) {
        s->tick = 0; /* which goes with what is returned */
        s->rests(d);
        return G_SOURCE_REMOVE;
    }
    stencil_show(d);
    return G_SOURCE_CONTINUE;
}

static bool springs_make(struct desk *d)
{
    const struct studio_type type = {d->typed->str, d->font, d->features ? d->features : "",
                                     d->type_x, d->type_y};
    struct studio_springs *springs;
    if (!d->typed->str[strspn(d->typed->str, " \n\t")])
        return false;
    if (studio_springs_create(&type, &d->settings, d->seen.width, d->seen.height, &springs) !=
        PAPER_OK) {
        desk_say(d, studio_session_error());
        return false;
    }
    d->springs = g_new0(struct desk_springs, 1);
    d->springs->springs = springs;
    d->springs->deeds = g_array_new(FALSE, FALSE, sizeof(struct deed));
    return true;
}

bool desk_springs_take(struct desk *d, double time_s, double x, double y,
                       void (*rests)(struct desk *d))
{
    const bool flies = d->springs != NULL;
    if (!d->typing || d->settings.value[STUDIO_TYPE_SPRINGS] == 0)
        return false;
    if (!flies && !springs_make(d))
        return false;
    struct desk_springs *s = d->springs;
    time_go(s, 0);
    s->held = studio_springs_take(s->springs, x, y);
    s->rests = rests;
    s->deed_s = time_s;
    s->since_s = 0;
    if (!flies && !s->held) {
        desk_springs_drop(d);
        return false;
    }
    if (!flies)
        s->tick = gtk_widget_add_tick_callback(d->canvas, tick, d, NULL);
    return true; /* a click beside what flies begins no other type */
}

bool desk_springs_held(const struct desk *d)
{
    return d->springs && d->springs->held;
}

void desk_springs_move(struct desk *d, double time_s, double x, double y)
{
    const struct deed deed = {time_s, x, y, false};
    g_array_append_val(d->springs->deeds, deed);
}

void desk_springs_let_go(struct desk *d, double time_s)
{
    const struct deed deed = {.time_s = time_s, .ends = true};
    if (!desk_springs_held(d))
        return;
    d->springs->held = false;
    g_array_append_val(d->springs->deeds, deed);
}

void desk_springs_print(struct desk *d)
{
    struct studio_message m = {.kind = STUDIO_MESSAGE_SCREEN};
    int x = 0, y = 0;
    if (!drawn(d, &m.screen, &x, &y) || !m.screen.gray)
        return;
    m.type_x = x;
    m.type_y = y;
    studio_paper_send(d->paper, m);
}

void desk_springs_drop(struct desk *d)
{
    struct desk_springs *s = d->springs;
    if (!s)
        return;
    d->springs = NULL;
    if (s->tick && d->window) /* with the window it has gone already */
        gtk_widget_remove_tick_callback(d->canvas, s->tick);
    studio_springs_destroy(s->springs);
    g_array_free(s->deeds, TRUE);
    g_free(s);
}
