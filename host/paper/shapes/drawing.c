/* drawing.c - drawings as bytes, and screens from them.
 *
 *     'P' count(4) x y x y ...              a polygon
 *     'T' numbers, flags, texts             a line of type (line_pass())
 *     '+' '*' '-'                           the last two become one
 *     'N' operation(1) first(1) number      the last one, and a number
 *
 * Bytes may come from a file: numbers and counts are checked, and no shape is larger than the
 * sheet. */
#include "drawing.h"

#include "base/base.h"
#include "sheet.h"

#include <stdlib.h>
#include <string.h>

enum { DEPTH_MOST = 32, NO_TEXT = 0xffff };

/* ---- bytes ---- */

void paper_drawing_polygon(struct event_bytes *b, const double *points, int points_count)
{
    event_put_number(b, 'P', 1);
    event_put_number(b, (uint64_t)points_count, 4);
    for (int i = 0; i < 2 * points_count; i++)
        event_put_double(b, points[i]);
}

void paper_drawing_again(struct event_bytes *b, const struct paper_drawing *d)
{
    event_put_bytes(b, d->bytes, d->count);
}

void paper_drawing_join(struct event_bytes *b, char operation)
{
    event_put_number(b, (uint64_t)operation, 1);
}

void paper_drawing_number(struct event_bytes *b, char operation, double number, bool first)
{
    event_put_number(b, 'N', 1);
    event_put_number(b, (uint64_t)operation, 1);
    event_put_number(b, first, 1);
    event_put_double(b, number);
}

static void text_put(struct event_bytes *b, const char *text)
{
    const size_t length = text ? strlen(text) : NO_TEXT;
    event_put_number(b, length < NO_TEXT ? length : NO_TEXT, 2);
    if (length < NO_TEXT)
        event_put_bytes(b, text, length + 1);
}

/* The next text, in place; NULL: none. */
static const char *text_get(struct event_reader *r)
{
    const size_t length = (size_t)event_get_number(r, 2);
    if (r->bad || length == NO_TEXT)
        return NULL;
    const char *text = (const char *)event_get_bytes(r, length + 1);
    if (text && memchr(text, 0, length + 1) != text + length)
        r->bad = true;
    return r->bad ? NULL : text;
}

/* The line's numbers and texts, in the order in which they are kept. */
enum { LINE_NUMBERS = 7, LINE_TEXTS = 6, LINE_CORNERS = 8 };

static void line_members(struct paper_line *line, double *numbers[LINE_NUMBERS],
                         const char **texts[LINE_TEXTS])
{
    double *const all[LINE_NUMBERS] = {&line->size_px,   &line->tracking_em, &line->anchor,
                                       &line->angle_deg, &line->width_px,    &line->leading,
                                       &line->darken_px};
    const char **const named[LINE_TEXTS] = {&line->text,     &line->font,     &line->filter,
                                            &line->features, &line->language, &line->axes};
    memcpy(numbers, all, sizeof all);
    memcpy(texts, named, sizeof named);
}

bool paper_drawing_line(struct event_bytes *b, const struct paper_line *line, double x,
                        double y)
{
    struct paper_line of = *line;
    double *numbers[LINE_NUMBERS];
    const char **texts[LINE_TEXTS];
    if (!of.text || !of.font || strchr(of.font, '/') || strlen(of.text) >= NO_TEXT)
        return false;
    line_members(&of, numbers, texts);
    event_put_number(b, 'T', 1);
    event_put_double(b, x);
    event_put_double(b, y);
    for (int i = 0; i < LINE_NUMBERS; i++)
        event_put_double(b, *numbers[i]);
    event_put_number(b, (uint64_t)of.align, 1);
    event_put_number(b, (uint64_t)(of.right_to_left + 1), 1);
    event_put_number(b, of.bilinear, 1);
    event_put_number(b, of.corners != NULL, 1);
    for (int i = 0; of.corners && i < LINE_CORNERS; i++)
        event_put_double(b, of.corners[i]);
    for (int i = 0; i < LINE_TEXTS; i++)
        text_put(b, *texts[i]);
    return true;
}

/* ---- grays: what has been drawn so far ---- */

struct gray {
    int x, y, width, height;
    uint8_t outside; /* the value everywhere else */
    uint8_t *at;     /* NULL: nothing */
};

struct canvas {
    struct event_reader r;
    double scale;
    int width, height;
    int depth;
    struct gray stack[DEPTH_MOST];
};

static int gray_at(const struct gray *g, int x, int y)
{
    if (!g->at || x < g->x || y < g->y || x >= g->x + g->width || y >= g->y + g->height)
        return g->outside;
    return g->at[(size_t)(y - g->y) * (size_t)g->width + (size_t)(x - g->x)];
}

static enum paper_status no_drawing(void)
{
    return paper_fail(PAPER_BAD_FILE, "what a screen was drawn from is damaged");
}

static enum paper_status gray_new(struct gray *g, int x1, int y1, int x2, int y2)
{
    *g = (struct gray){.x = x1, .y = y1};
    if (x1 >= x2 || y1 >= y2)
        return PAPER_OK;
    g->width = x2 - x1;
    g->height = y2 - y1;
    g->at = calloc((size_t)g->height, (size_t)g->width);
    return g->at ? PAPER_OK
                 : paper_fail(PAPER_NO_MEMORY, "no memory for a shape of %dx%d", g->width,
                              g->height);
}

/* The part of the screen that lies on the sheet is the stack's next. */
static enum paper_status screen_push(struct canvas *c, const struct paper_screen *screen,
                                     int64_t x, int64_t y)
{
    const int64_t right = x + screen->width_px, bottom = y + screen->height_px;
    const int x1 = (int)(x > 0 ? x : 0), y1 = (int)(y > 0 ? y : 0),
              x2 = (int)(right < c->width ? right : c->width),
              y2 = (int)(bottom < c->height ? bottom : c->height);
    struct gray *g = &c->stack[c->depth];
    enum paper_status status = gray_new(g, x1, y1, x2, y2);
    for (int row = y1; g->at && row < y2; row++)
        memcpy(g->at + (size_t)(row - y1) * (size_t)g->width,
               screen->gray + (size_t)(row - y) * (size_t)screen->width_px + (x1 - x),
               (size_t)g->width);
    c->depth += status == PAPER_OK;
    return status;
}

static enum paper_status polygon_draw(struct canvas *c)
{
    const size_t count = (size_t)event_get_number(&c->r, 4);
    if (count < 3 || c->r.bad || count > (size_t)(c->r.end - c->r.at) / 16)
        return no_drawing();
    double *points = malloc(2 * count * sizeof *points);
    if (!points)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a polygon of %zu corners", count);
    for (size_t i = 0; i < 2 * count; i++)
        points[i] = event_get_double(&c->r) * c->scale;
    struct paper_screen screen;
    int x, y;
    enum paper_status status =
        paper_polygon_screen(points, (int)count, c->width, c->height, &screen, &x, &y);
    if (status == PAPER_OK)
        status = screen_push(c, &screen, x, y);
    paper_screen_destroy(&screen);
    free(points);
    return status;
}

static enum paper_status line_draw(struct canvas *c)
{
    struct paper_line line = {0};
    double *numbers[LINE_NUMBERS], corners[LINE_CORNERS];
    const char **texts[LINE_TEXTS];
    struct event_reader *r = &c->r;
    line_members(&line, numbers, texts);
    double x = event_get_double(r) * c->scale, y = event_get_double(r) * c->scale;
    for (int i = 0; i < LINE_NUMBERS; i++)
        *numbers[i] = event_get_double(r);
    const uint64_t align = event_get_number(r, 1), direction = event_get_number(r, 1);
    line.bilinear = event_get_number(r, 1) != 0;
    if (event_get_number(r, 1)) {
        for (int i = 0; i < LINE_CORNERS; i++)
            corners[i] = event_get_double(r) * c->scale;
        line.corners = corners;
        x = y = 0;
    }
    for (int i = 0; i < LINE_TEXTS; i++)
        *texts[i] = text_get(r);
    if (r->bad || !line.text || !line.font || strchr(line.font, '/') ||
        align > PAPER_ALIGN_JUSTIFY || direction > 2 || !(fabs(x) < 1e6 && fabs(y) < 1e6))
        return no_drawing();
    line.align = (enum paper_align)align;
    line.right_to_left = (int)direction - 1;
    line.size_px *= c->scale;
    line.width_px *= c->scale;
    line.darken_px *= c->scale;
    line.x_px = x - floor(x);
    line.y_px = y - floor(y);
    struct paper_screen screen;
    enum paper_status status = paper_line_screen(&line, &screen, NULL);
    if (status == PAPER_OK)
        status = screen_push(c, &screen, (int64_t)floor(x) - screen.origin_x_px,
                             (int64_t)floor(y) - screen.baseline_y_px);
    paper_screen_destroy(&screen);
    return status;
}

static int less(int a, int b)
{
    return a < b ? a : b;
}

static int more(int a, int b)
{
    return a > b ? a : b;
}

static enum paper_status grays_join(struct canvas *c, char operation)
{
    if (c->depth < 2)
        return no_drawing();
    struct gray *a = &c->stack[c->depth - 2], *b = &c->stack[c->depth - 1], made;
    int x1 = a->x, y1 = a->y, x2 = a->x + a->width, y2 = a->y + a->height;
    if ((operation == '+' || a->outside || b->outside) && b->at) {
        x1 = a->at ? less(x1, b->x) : b->x;
        y1 = a->at ? less(y1, b->y) : b->y;
        x2 = a->at ? more(x2, b->x + b->width) : b->x + b->width;
        y2 = a->at ? more(y2, b->y + b->height) : b->y + b->height;
    }
    enum paper_status status = gray_new(&made, x1, y1, x2, y2);
    if (status != PAPER_OK)
        return status;
    made.outside = (uint8_t)paper_gray_join(operation, a->outside, b->outside);
    for (int y = y1; made.at && y < y2; y++)
        for (int x = x1; x < x2; x++)
            made.at[(size_t)(y - y1) * (size_t)made.width + (size_t)(x - x1)] =
                (uint8_t)paper_gray_join(operation, gray_at(a, x, y), gray_at(b, x, y));
    free(a->at);
    free(b->at);
    *a = made;
    c->depth--;
    return PAPER_OK;
}

static enum paper_status gray_count(struct canvas *c)
{
    const char operation = (char)event_get_number(&c->r, 1);
    const bool first = event_get_number(&c->r, 1) != 0;
    const double number = event_get_double(&c->r);
    if (c->r.bad || c->depth < 1 || !strchr("+*-", operation) || !isfinite(number))
        return no_drawing();
    struct gray *g = &c->stack[c->depth - 1];
    for (size_t i = 0; g->at && i < (size_t)g->width * (size_t)g->height; i++)
        g->at[i] = paper_gray_number(operation, number, first, g->at[i]);
    g->outside = paper_gray_number(operation, number, first, g->outside);
    return PAPER_OK;
}

static enum paper_status shape_next(struct canvas *c)
{
    const char kind = (char)event_get_number(&c->r, 1);
    if ((kind == 'P' || kind == 'T') && c->depth == DEPTH_MOST)
        return no_drawing();
    switch (kind) {
    case 'P':
        return polygon_draw(c);
    case 'T':
        return line_draw(c);
    case 'N':
        return gray_count(c);
    case '+':
    case '*':
    case '-':
        return grays_join(c, kind);
    default:
        return no_drawing();
    }
}

/* What is left is the screen: of the whole sheet, where it is not 0 outside of its shape. */
static enum paper_status screen_make(const struct canvas *c, struct paper_screen *screen,
                                     int *x, int *y)
{
    const struct gray *g = &c->stack[0];
    struct gray made;
    enum paper_status status =
        g->outside || !g->at ? gray_new(&made, 0, 0, c->width, c->height)
                             : gray_new(&made, g->x, g->y, g->x + g->width, g->y + g->height);
    if (status != PAPER_OK)
        return status;
    for (int row = 0; row < made.height; row++)
        for (int column = 0; column < made.width; column++)
            made.at[(size_t)row * (size_t)made.width + (size_t)column] =
                (uint8_t)gray_at(g, made.x + column, made.y + row);
    *screen = (struct paper_screen){
        .width_px = made.width, .height_px = made.height, .gray = made.at};
    *x = made.x;
    *y = made.y;
    return PAPER_OK;
}

enum paper_status paper_drawing_screen(const struct paper_drawing *d, double scale, int width,
                                       int height, struct paper_screen *screen, int *x, int *y)
{
    struct canvas c = {.r = {d->bytes, d->bytes + d->count, false},
                       .scale = scale,
                       .width = width,
                       .height = height};
    enum paper_status status = PAPER_OK;
    *screen = (struct paper_screen){0};
    *x = *y = 0;
    while (status == PAPER_OK && c.r.at < c.r.end)
        status = shape_next(&c);
    if (status == PAPER_OK && (c.depth != 1 || c.r.bad))
        status = no_drawing();
    if (status == PAPER_OK)
        status = screen_make(&c, screen, x, y);
    while (c.depth > 0)
        free(c.stack[--c.depth].at);
    return status;
}

size_t paper_drawing_within(const struct paper_drawing *d)
{
    struct event_reader r = {d->bytes, d->bytes + d->count, false};
    size_t before = 0; /* the last thing that is done */
    bool around = false;
    int depth = 0;
    while (r.at < r.end && !r.bad) {
        before = (size_t)(r.at - d->bytes);
        around = false;
        const char kind = (char)event_get_number(&r, 1);
        if (kind == 'P') {
            const size_t count = (size_t)event_get_number(&r, 4);
            if (count < 3 || r.bad || count > (size_t)(r.end - r.at) / 16)
                return 0;
            r.at += 16 * count;
            depth++;
        } else if (kind == 'N') {
            const uint64_t operation = event_get_number(&r, 1), first = event_get_number(&r, 1);
            around = event_get_double(&r) == 1 && operation == '-' && first == 1;
        } else if (kind == '+' || kind == '*' || kind == '-') {
            depth--;
        } else {
            return 0;
        }
        if (depth < 1 || depth > DEPTH_MOST)
            return 0;
    }
    return around && depth == 1 && !r.bad ? before : 0;
}

bool paper_drawing_around(const struct paper_drawing *d, double **points, int *points_count)
{
    struct event_reader r = {d->bytes, d->bytes + d->count, false};
    const bool polygon = event_get_number(&r, 1) == 'P';
    const size_t count = (size_t)event_get_number(&r, 4);
    *points = NULL;
    *points_count = 0;
    if (!polygon || r.bad || count < 3 || count > (size_t)(r.end - r.at) / 16)
        return false;
    double *made = malloc(2 * count * sizeof *made);
    bool finite = made != NULL;
    for (size_t i = 0; made && i < 2 * count; i++) {
        made[i] = event_get_double(&r) * d->scale;
        finite = finite && isfinite(made[i]);
    }
    const bool around = finite && event_get_number(&r, 1) == 'N' &&
                        event_get_number(&r, 1) == '-' && event_get_number(&r, 1) == 1 &&
                        event_get_double(&r) == 1 && !r.bad && r.at == r.end;
    if (!around) {
        free(made);
        return false;
    }
    *points = made;
    *points_count = (int)count;
    return true;
}
