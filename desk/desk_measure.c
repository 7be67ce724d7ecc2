/* desk_measure.c - how long the window takes: from what a hand does to the picture that shows
 * it, and pictures a second. Recorded input turns it on by `measure NAME`; each measurement
 * ends with the next one, or with the window, and is a line on the standard output:
 *
 *     measured NAME SECONDS PICTURES PROCESSOR_SECONDS SHOWN MEDIAN_S P99_S LONGEST_S STEPS
 *
 * SHOWN counts what was sent to the paper and has been seen since. While something is measured
 * the window draws as often as it can. A picture counts when it has been given to the display.
 * `none` is the name of what is not told. */
#include "desk.h"

#include <stdlib.h>
#include <time.h>

struct sent {
    unsigned long number; /* of its message */
    double time_s;
};

struct desk_measure {
    struct desk *desk;
    GdkFrameClock *clock;
    char name[64];
    double began_s, processor_s;
    long steps;
    unsigned pictures;
    unsigned long drawn; /* the number of the last message that the picture being drawn shows */
    bool drawing;
    GArray *sent; /* struct sent, not seen yet */
    GArray *took; /* double */
};

static double processor_now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static gboolean draw_again(GtkWidget *canvas, GdkFrameClock *clock, gpointer data)
{
    (void)clock;
    (void)data;
    gtk_gl_area_queue_render(GTK_GL_AREA(canvas));
    return G_SOURCE_CONTINUE;
}

/* The picture has been given to the display. */
static void painted(GdkFrameClock *clock, struct desk_measure *m)
{
    const double now_s = input_now_s();
    guint seen = 0;
    (void)clock;
    if (!m->drawing)
        return;
    m->drawing = false;
    m->pictures++;
    for (; seen < m->sent->len; seen++) {
        const struct sent *sent = &g_array_index(m->sent, struct sent, seen);
        if (sent->number > m->drawn)
            break;
        const double took_s = now_s - sent->time_s;
        g_array_append_val(m->took, took_s);
    }
    if (seen > 0)
        g_array_remove_range(m->sent, 0, seen);
}

static int ascending(gconstpointer a, gconstpointer b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double part_of(const GArray *sorted, double part)
{
    return sorted->len
               ? g_array_index(sorted, double, (guint)(part * (double)(sorted->len - 1)))
               : 0;
}

static void measurement_end(struct desk_measure *m)
{
    if (!m->name[0])
        return;
    const double now_s = input_now_s();
    g_array_sort(m->took, ascending);
    if (strcmp(m->name, "none") != 0)
        g_print("measured %s %.6f %u %.6f %u %.6f %.6f %.6f %ld\n", m->name, now_s - m->began_s,
                m->pictures, processor_now_s() - m->processor_s, m->took->len,
                part_of(m->took, 0.5), part_of(m->took, 0.99), part_of(m->took, 1),
                m->desk->report.steps - m->steps);
    m->name[0] = '\0';
}

static struct desk_measure *measure_new(struct desk *d)
{
    struct desk_measure *m = g_new0(struct desk_measure, 1);
    m->desk = d;
    m->sent = g_array_new(FALSE, FALSE, sizeof(struct sent));
    m->took = g_array_new(FALSE, FALSE, sizeof(double));
    gtk_widget_add_tick_callback(d->canvas, draw_again, NULL, NULL);
    m->clock = g_object_ref(gtk_widget_get_frame_clock(d->canvas));
    g_signal_connect(m->clock, "after-paint", G_CALLBACK(painted), m);
    return m;
}

void desk_measure_begin(struct desk *d, const char *name)
{
    if (!d->measure)
        d->measure = measure_new(d);
    struct desk_measure *m = d->measure;
    measurement_end(m);
    g_array_set_size(m->sent, 0);
    g_array_set_size(m->took, 0);
    g_strlcpy(m->name, name, sizeof m->name);
    m->pictures = 0;
    m->steps = d->report.steps;
    m->began_s = input_now_s();
    m->processor_s = processor_now_s();
}

void desk_measure_sent(struct desk *d, unsigned long number)
{
    const struct sent sent = {number, input_now_s()};
    if (d->measure && number > 0)
        g_array_append_val(d->measure->sent, sent);
}

void desk_measure_drawn(struct desk *d)
{
    if (!d->measure)
        return;
    d->measure->drawn = d->seen.heard;
    d->measure->drawing = true;
}

void desk_measure_end(struct desk *d)
{
    struct desk_measure *m = d->measure;
    if (!m)
        return;
    measurement_end(m);
    g_signal_handlers_disconnect_by_data(m->clock, m);
    g_object_unref(m->clock);
    g_array_free(m->sent, TRUE);
    g_array_free(m->took, TRUE);
    g_free(m);
    d->measure = NULL;
}
