/* path.c - SVG paths as chords.
 *
 * A path is a sequence of commands, each a letter and its numbers; the numbers may be
 * repeated without the letter. The table `commands` gives for each command its numbers, and
 * the function that draws it.
 */
#include "path.h"

#include <array.h>

#include "base/base.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS_MAX = 200000, LINES_MAX = 20000, CHORDS_MAX = 500, ARGUMENTS_MAX = 7 };
#define PLACE_MAX 1e6
#define PI 3.14159265358979323846

struct pen {
    const char *path;
    const char *at;
    double tolerance;
    double x, y;           /* where it is */
    double from_x, from_y; /* where the sub-path began */
    double turn_x, turn_y; /* the last control point, for S and T */
    char last;             /* command, upper case */
    bool open;             /* a line has been begun */
    int points_count, room, lines_room;
    struct paper_lines *lines;
    enum paper_status status;
};

void paper_lines_destroy(struct paper_lines *lines)
{
    for (int i = 0; i < lines->count; i++)
        free(lines->line[i].points);
    free(lines->line);
    *lines = (struct paper_lines){0};
}

static void pen_fail(struct pen *pen, const char *what)
{
    if (pen->status == PAPER_OK)
        pen->status = paper_fail(PAPER_BAD_ARGUMENT, "path, character %d: %s",
                                 (int)(pen->at - pen->path) + 1, what);
}

static void no_memory(struct pen *pen)
{
    pen->status = paper_fail(PAPER_NO_MEMORY, "no memory for a path");
}

/* ---- points ---- */

static void point_add(struct pen *pen, double x, double y)
{
    if (pen->status != PAPER_OK)
        return;
    if (!(fabs(x) <= PLACE_MAX && fabs(y) <= PLACE_MAX)) {
        pen_fail(pen, "it leads further than 1000000 away");
        return;
    }
    if (pen->points_count++ == POINTS_MAX) {
        pen_fail(pen, "it has more than 200000 points");
        return;
    }
    struct paper_way *line = &pen->lines->line[pen->lines->count - 1];
    if (!array_reserve(&line->points, &pen->room, line->points_count + 1,
                       2 * sizeof *line->points)) {
        no_memory(pen);
        return;
    }
    line->points[2 * line->points_count] = x;
    line->points[2 * line->points_count + 1] = y;
    line->points_count++;
    pen->x = x;
    pen->y = y;
}

/* A line begins with the first segment after a move. */
static void line_open(struct pen *pen)
{
    if (pen->open || pen->status != PAPER_OK)
        return;
    if (pen->lines->count == LINES_MAX) {
        pen_fail(pen, "it has more than 20000 sub-paths");
        return;
    }
    if (!array_reserve(&pen->lines->line, &pen->lines_room, pen->lines->count + 1,
                       sizeof *pen->lines->line)) {
        no_memory(pen);
        return;
    }
    pen->lines->line[pen->lines->count++] = (struct paper_way){0};
    pen->room = 0;
    pen->open = true;
    point_add(pen, pen->x, pen->y);
}

static int chords(double wanted)
{
    return wanted >= CHORDS_MAX ? CHORDS_MAX : wanted > 1 ? (int)ceil(wanted) : 1;
}

/* ---- what the commands draw; a: absolute numbers ---- */

static void draw_move(struct pen *pen, const double *a)
{
    pen->x = pen->from_x = a[0];
    pen->y = pen->from_y = a[1];
    pen->open = false;
    if (!(fabs(a[0]) <= PLACE_MAX && fabs(a[1]) <= PLACE_MAX))
        pen_fail(pen, "it leads further than 1000000 away");
}

static void draw_line(struct pen *pen, const double *a)
{
    line_open(pen);
    point_add(pen, a[0], a[1]);
}

static void draw_cubic(struct pen *pen, const double *a)
{
    double x = pen->x, y = pen->y;
    line_open(pen);
    /* the chord of 1/n of a cubic is off by at most 1/8 of its greatest second derivative over
     * n^2 */
    double bend = fmax(hypot(x - 2 * a[0] + a[2], y - 2 * a[1] + a[3]),
                       hypot(a[0] - 2 * a[2] + a[4], a[1] - 2 * a[3] + a[5]));
    int count = chords(sqrt(0.75 * bend / pen->tolerance));
    for (int i = 1; i < count; i++) {
        double u = (double)i / count, v = 1 - u;
        double b0 = v * v * v, b1 = 3 * v * v * u, b2 = 3 * v * u * u, b3 = u * u * u;
        point_add(pen, b0 * x + b1 * a[0] + b2 * a[2] + b3 * a[4],
                  b0 * y + b1 * a[1] + b2 * a[3] + b3 * a[5]);
    }
    point_add(pen, a[4], a[5]);
    pen->turn_x = a[2];
    pen->turn_y = a[3];
}

static void draw_smooth_cubic(struct pen *pen, const double *a)
{
    bool after = pen->last == 'C' || pen->last == 'S';
    draw_cubic(pen,
               (double[6]){after ? 2 * pen->x - pen->turn_x : pen->x,
                           after ? 2 * pen->y - pen->turn_y : pen->y, a[0], a[1], a[2], a[3]});
}

static void draw_quadratic(struct pen *pen, const double *a)
{
    double x = pen->x, y = pen->y, cx = a[0], cy = a[1];
    draw_cubic(pen,
               (double[6]){x + 2 * (cx - x) / 3, y + 2 * (cy - y) / 3,
                           a[2] + 2 * (cx - a[2]) / 3, a[3] + 2 * (cy - a[3]) / 3, a[2], a[3]});
    pen->turn_x = cx;
    pen->turn_y = cy;
}

static void draw_smooth_quadratic(struct pen *pen, const double *a)
{
    bool after = pen->last == 'Q' || pen->last == 'T';
    draw_quadratic(pen, (double[4]){after ? 2 * pen->x - pen->turn_x : pen->x,
                                    after ? 2 * pen->y - pen->turn_y : pen->y, a[0], a[1]});
}

/* rx, ry, rotation, large, sweep, x, y. The centre is computed after a transform that turns
 * the ellipse into a unit circle: there it lies on the perpendicular through the middle of
 * the chord. */
static void draw_arc(struct pen *pen, const double *a)
{
    double rx = fabs(a[0]), ry = fabs(a[1]), turn = a[2] * PI / 180;
    double c = cos(turn), s = sin(turn);
    double dx = a[5] - pen->x, dy = a[6] - pen->y;
    if (rx == 0 || ry == 0 || (dx == 0 && dy == 0)) {
        draw_line(pen, a + 5);
        return;
    }
    double u = (c * dx + s * dy) / rx, v = (c * dy - s * dx) / ry, chord = hypot(u, v);
    if (!(chord > 0) || !isfinite(chord)) { /* radii far larger or smaller than the chord:
                                             * not representable */
        draw_line(pen, a + 5);
        return;
    }
    double half = chord / 2, grown = half > 1 ? half : 1; /* radii that are too small are
                                                           * enlarged */
    rx *= grown;
    ry *= grown;
    u /= grown;
    v /= grown;
    half /= grown;
    double up = sqrt(fmax(0, 1 - half * half)) * ((a[3] != 0) == (a[4] != 0) ? -1 : 1);
    double mx = u / 2 - up * v / (2 * half), my = v / 2 + up * u / (2 * half);
    double from = atan2(-my, -mx), to = atan2(v - my, u - mx), sweep = to - from;
    if (a[4] != 0 && sweep < 0)
        sweep += 2 * PI;
    if (a[4] == 0 && sweep > 0)
        sweep -= 2 * PI;
    double slack = fmin(1, pen->tolerance / fmax(rx, ry));
    int count = chords(fmax(fabs(sweep) / (2 * acos(1 - slack)), fabs(sweep) / (PI / 2)));
    double x0 = pen->x, y0 = pen->y;
    line_open(pen);
    for (int i = 1; i < count; i++) {
        double angle = from + sweep * i / count;
        double px = rx * (mx + cos(angle)), py = ry * (my + sin(angle));
        point_add(pen, x0 + c * px - s * py, y0 + s * px + c * py);
    }
    point_add(pen, a[5], a[6]);
}

static void draw_close(struct pen *pen, const double *a)
{
    (void)a;
    line_open(pen);
    if (pen->x != pen->from_x || pen->y != pen->from_y)
        point_add(pen, pen->from_x, pen->from_y);
    pen->open = false;
}

/* kinds: the type of each number: x, y, a plain number (n), or a flag (f) */
static const struct command {
    char letter;
    const char *kinds;
    void (*draw)(struct pen *pen, const double *a);
} commands[] = {
    {'M', "xy", draw_move},
    {'L', "xy", draw_line},
    {'H', "x", NULL},
    {'V', "y", NULL},
    {'C', "xyxyxy", draw_cubic},
    {'S', "xyxy", draw_smooth_cubic},
    {'Q', "xyxy", draw_quadratic},
    {'T', "xy", draw_smooth_quadratic},
    {'A', "nnnffxy", draw_arc},
    {'Z', "", draw_close},
};

/* ---- reading ---- */

static void space_skip(struct pen *pen, bool comma)
{
    while (*pen->at && strchr(" \t\r\n\f", *pen->at))
        pen->at++;
    if (comma && *pen->at == ',') {
        pen->at++;
        space_skip(pen, false);
    }
}

/* [+-] digits [. digits] [e [+-] digits]: strtod() would also accept hexadecimal, nan and
 * inf. */
static bool number_read(struct pen *pen, double *out)
{
    char text[64];
    size_t length = 0;
    const char *c = pen->at;
    bool digits = false;
    if (*c == '+' || *c == '-')
        c++;
    for (; *c >= '0' && *c <= '9'; c++)
        digits = true;
    if (*c == '.')
        for (c++; *c >= '0' && *c <= '9'; c++)
            digits = true;
    if (digits && (*c == 'e' || *c == 'E')) {
        const char *e = c + 1;
        if (*e == '+' || *e == '-')
            e++;
        if (*e >= '0' && *e <= '9')
            for (c = e; *c >= '0' && *c <= '9'; c++)
                ;
    }
    length = (size_t)(c - pen->at);
    if (!digits || length >= sizeof text)
        return false;
    memcpy(text, pen->at, length);
    text[length] = '\0';
    *out = strtod(text, NULL);
    pen->at = c;
    return isfinite(*out);
}

static bool flag_read(struct pen *pen, double *out)
{
    if (*pen->at != '0' && *pen->at != '1')
        return false;
    *out = *pen->at++ - '0';
    return true;
}

static void command_draw(struct pen *pen, const struct command *command, bool relative)
{
    double a[ARGUMENTS_MAX] = {0};
    for (int i = 0; command->kinds[i]; i++) {
        char kind = command->kinds[i];
        space_skip(pen, i > 0);
        if (!(kind == 'f' ? flag_read(pen, &a[i]) : number_read(pen, &a[i]))) {
            pen_fail(pen, kind == 'f' ? "a flag, 0 or 1, is wanted" : "a number is wanted");
            return;
        }
        if (relative && kind == 'x')
            a[i] += pen->x;
        if (relative && kind == 'y')
            a[i] += pen->y;
    }
    if (command->letter == 'H')
        draw_line(pen, (double[2]){a[0], pen->y});
    else if (command->letter == 'V')
        draw_line(pen, (double[2]){pen->x, a[0]});
    else
        command->draw(pen, a);
    pen->last = command->letter;
}

static const struct command *command_find(char letter)
{
    char upper = letter >= 'a' && letter <= 'z' ? (char)(letter - 'a' + 'A') : letter;
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        if (commands[i].letter == upper)
            return &commands[i];
    return NULL;
}

enum paper_status paper_path_parse(const char *path, double tolerance,
                                   struct paper_lines *lines)
{
    *lines = (struct paper_lines){0};
    if (!(tolerance > 0))
        return paper_fail(PAPER_BAD_ARGUMENT, "a path's tolerance must be above 0 (got %g)",
                          tolerance);
    struct pen pen = {.path = path, .at = path, .tolerance = tolerance, .lines = lines};
    const struct command *command = NULL;
    bool relative = false;
    for (space_skip(&pen, false); *pen.at && pen.status == PAPER_OK;) {
        const struct command *named = command_find(*pen.at);
        if (named) {
            relative = *pen.at >= 'a';
            if (!command && named->letter != 'M')
                pen_fail(&pen, "a path begins with M");
            command = named;
            pen.at++;
        } else if (!command || command->letter == 'Z') {
            pen_fail(&pen, "a command is wanted, one of MLHVCSQTAZ");
        }
        if (pen.status == PAPER_OK)
            command_draw(&pen, command, relative);
        if (command && command->letter == 'M') /* more pairs are lines */
            command = command_find('L');
        space_skip(&pen, command && command->letter != 'Z');
    }
    if (pen.status != PAPER_OK)
        paper_lines_destroy(lines);
    return pen.status;
}
