/* scale.c - operations and sheets at another resolution: numbers as their members' rows say, screens and planes resampled. */
#include "arguments/members.h"
#include "event/event.h"

#include <math.h>
#include <stdlib.h>

/* ---- resampling ---- */

/* Weights of the sources of one place along a row: a tent two sources wide, or two new places wide where these are fewer. */
struct tent {
    int first, count;
    double weights[512];
};

static void tent_make(struct tent *tent, int place, double scale)
{
    double center = (place + 0.5) / scale - 0.5, reach = scale < 1 ? 1 / scale : 1;
    reach = reach < 250 ? reach : 250;
    tent->first = (int)floor(center - reach) + 1;
    tent->count = 0;
    double sum = 0;
    for (int i = tent->first; i < center + reach && tent->count < 512; i++) {
        double weight = 1 - fabs(i - center) / reach;
        tent->weights[tent->count++] = weight;
        sum += weight;
    }
    for (int i = 0; i < tent->count; i++)
        tent->weights[i] /= sum;
}

/* new[x, y] of a grid whose 0, 0 is at x0, y0 of the new sheet, from an old one whose 0, 0 is at old_x, old_y of the old sheet.
 * Beyond the edge there is 0, or what is at the edge. */
struct resampled {
    double scale;
    int x0, y0, width, height;
    int old_x, old_y, old_width, old_height;
    bool edge_goes_on;
};

/* One number from `tent` of a line of `count` numbers, `stride` apart, whose first is at `first` of the old sheet. */
static float tent_sum(const struct tent *tent, const float *line, size_t stride, int first,
                      int count, bool edge_goes_on)
{
    double sum = 0;
    for (int i = 0; i < tent->count; i++) {
        int at = tent->first + i - first, last = count - 1;
        if (edge_goes_on)
            at = at < 0 ? 0 : at > last ? last : at;
        if (at >= 0 && at <= last)
            sum += tent->weights[i] * (double)line[(size_t)at * stride];
    }
    return (float)sum;
}

static bool resample(const struct resampled *r, const float *old, float *new)
{
    size_t width = (size_t)r->width, old_width = (size_t)r->old_width;
    float *rows = calloc(width * (size_t)r->old_height, sizeof *rows);
    struct tent *tent = malloc(sizeof *tent);
    bool done = rows && tent;
    for (int x = 0; done && x < r->width; x++) {
        tent_make(tent, x + r->x0, r->scale);
        for (int y = 0; y < r->old_height; y++)
            rows[(size_t)y * width + (size_t)x] = tent_sum(
                tent, old + (size_t)y * old_width, 1, r->old_x, r->old_width, r->edge_goes_on);
    }
    for (int y = 0; done && y < r->height; y++) {
        tent_make(tent, y + r->y0, r->scale);
        for (int x = 0; x < r->width; x++)
            new[(size_t)y * width + (size_t)x] =
                tent_sum(tent, rows + x, width, r->old_y, r->old_height, r->edge_goes_on);
    }
    free(rows);
    free(tent);
    return done;
}

/* *values, an array of our own, becomes one of the new size. */
static bool array_resample(const struct resampled *r, const float **values)
{
    float *new = malloc((size_t)r->width * (size_t)r->height * sizeof *new);
    bool done = new &&resample(r, *values, new);
    free(done ? event_owned(*values) : new);
    if (done)
        *values = new;
    return done;
}

/* ---- members ---- */

static bool place_scale(struct paper_place *place, const struct event_scaling *scaling)
{
    struct paper_screen *screen = event_owned(place->screen);
    if (!screen)
        return true;
    struct resampled r = {.scale = scaling->length,
                          .old_x = place->x,
                          .old_y = place->y,
                          .old_width = screen->width_px,
                          .old_height = screen->height_px};
    double s = scaling->length;
    /* edges of a pixel of the old sheet spread over as much of the new one */
    r.x0 = (int)fmax(0, floor((place->x - 1) * s));
    r.y0 = (int)fmax(0, floor((place->y - 1) * s));
    int x1 = (int)fmin(scaling->new_width, ceil((place->x + screen->width_px + 1) * s));
    int y1 = (int)fmin(scaling->new_height, ceil((place->y + screen->height_px + 1) * s));
    r.width = x1 > r.x0 ? x1 - r.x0 : 1;
    r.height = y1 > r.y0 ? y1 - r.y0 : 1;
    size_t old_count = (size_t)r.old_width * (size_t)r.old_height,
           count = (size_t)r.width * (size_t)r.height;
    float *old = malloc(old_count * sizeof *old), *new = malloc(count * sizeof *new);
    uint8_t *gray = malloc(count);
    bool done = old && new &&gray;
    for (size_t i = 0; done && i < old_count; i++)
        old[i] = screen->gray[i];
    done = done && resample(&r, old, new);
    for (size_t i = 0; done && i < count; i++)
        gray[i] = (uint8_t)lrintf(new[i]);
    free(done ? screen->gray : gray);
    if (done) {
        *screen =
            (struct paper_screen){.width_px = r.width, .height_px = r.height, .gray = gray};
        place->x = r.x0;
        place->y = r.y0;
    }
    free(old);
    free(new);
    return done;
}

static bool plane_scale(const float **values, const struct event_scaling *scaling)
{
    struct resampled r = {.scale = scaling->length,
                          .width = scaling->new_width,
                          .height = scaling->new_height,
                          .old_width = scaling->width,
                          .old_height = scaling->height,
                          .edge_goes_on = true};
    return array_resample(&r, values);
}

static bool amounts_scale(struct paper_print *print, const struct event_scaling *scaling)
{
    double s = scaling->length;
    struct resampled r = {.scale = s,
                          .x0 = (int)floor(print->x * s),
                          .y0 = (int)floor(print->y * s),
                          .width = (int)fmin(PAPER_SIDE_MAX, fmax(1, round(print->width * s))),
                          .height =
                              (int)fmin(PAPER_SIDE_MAX, fmax(1, round(print->height * s))),
                          .old_x = print->x,
                          .old_y = print->y,
                          .old_width = print->width,
                          .old_height = print->height,
                          .edge_goes_on = true};
    bool done = true;
    for (int i = 0; i <= PAPER_PIGMENTS_MAX && done; i++)
        done = !print->amount[i] || array_resample(&r, &print->amount[i]);
    print->x = r.x0;
    print->y = r.y0;
    print->width = r.width;
    print->height = r.height;
    return done;
}

static double number_scale(const struct member *m, double value,
                           const struct event_scaling *scaling)
{
    double length = scaling->length, pace = scaling->pace;
    switch (m->scaling) {
    case SCALE_NOT:
        return value;
    case SCALE_LENGTH:
        value *= length;
        break;
    case SCALE_RATE:
        value /= pace;
        break;
    case SCALE_SPREAD:
        value *= length * length / pace;
        break;
    case SCALE_PULL:
        value *= length / pace;
        break;
    case SCALE_PACE:
        value *= pace;
        break;
    }
    return m->least < m->most ? fmin(m->most, fmax(m->least, value)) : value;
}

static bool members_scale(const struct members *members, void *of,
                          const struct event_scaling *scaling);

static bool samples_scale(struct paper_stroke *stroke, const struct event_scaling *scaling)
{
    struct paper_stroke_sample *samples = event_owned(stroke->samples);
    for (int i = 0; i < stroke->samples_count; i++)
        if (!members_scale(&event_sample_members, &samples[i], scaling))
            return false;
    return true;
}

/* False where memory is short. */
static bool member_scale(const struct member *m, void *of, const struct event_scaling *scaling)
{
    void *start = (char *)of + m->offset;
    switch (m->kind) {
    case MEMBER_DOUBLE:
        for (int i = 0; i < m->count; i++)
            ((double *)start)[i] = number_scale(m, ((double *)start)[i], scaling);
        return true;
    case MEMBER_INT:
        for (int i = 0; i < m->count; i++)
            ((int *)start)[i] = (int)lround(number_scale(m, ((int *)start)[i], scaling));
        return true;
    case MEMBER_PLACE:
        return place_scale(start, scaling);
    case MEMBER_PLANE:
        return plane_scale(start, scaling);
    case MEMBER_SAMPLES:
        return samples_scale(of, scaling);
    case MEMBER_AMOUNTS:
        return amounts_scale(of, scaling);
    case MEMBER_WORD:
    case MEMBER_FLAG:
    case MEMBER_TEXT:
        break;
    }
    return true;
}

static bool members_scale(const struct members *members, void *of,
                          const struct event_scaling *scaling)
{
    bool memory = true;
    for (size_t i = 0; i < members->count && memory; i++)
        memory = member_scale(&members->first[i], of, scaling);
    return memory;
}

/* ---- operations and sheets ---- */

enum paper_status event_scale(enum sheet_event_kind kind, void *arguments,
                              const struct event_scaling *scaling)
{
    if (!members_scale(event_members(kind), arguments, scaling))
        return paper_fail(PAPER_NO_MEMORY, "no memory for an event (%s) at another resolution",
                          event_name(kind));
    return PAPER_OK;
}

void event_config_scale(struct paper_sheet_config *config, const struct event_scaling *scaling)
{
    config->width = scaling->new_width;
    config->height = scaling->new_height;
    members_scale(&event_stock_members, &config->stock, scaling);
}
