/* outline_path.c - SVG's paths as outlines: see edits_internal.h. Curves stay curves; arcs are
 * refused, since an outline has none. */
#include "edits_internal.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* A command and its numbers. */
static const struct {
    char letter;
    int count;
} commands[] = {{'M', 2}, {'L', 2}, {'H', 1}, {'V', 1}, {'C', 6},
                {'S', 4}, {'Q', 4}, {'T', 2}, {'Z', 0}};
enum { COMMANDS = sizeof commands / sizeof *commands };

struct pen {
    const double *map;
    struct font_outline *outline;
    struct font_point at, from, turn; /* turn: the last control point, for S and T */
    char last;
    enum font_status status;
};

static struct font_point mapped(const struct pen *pen, struct font_point p)
{
    const double *m = pen->map;
    return (struct font_point){m[0] * p.x + m[2] * p.y + m[4], m[1] * p.x + m[3] * p.y + m[5]};
}

static void line_draw(struct pen *pen, double x, double y)
{
    pen->at = (struct font_point){x, y};
    struct font_point to = mapped(pen, pen->at);
    pen->status = font_outline_line(pen->outline, to.x, to.y);
}

static void curve_draw(struct pen *pen, struct font_point a, struct font_point b,
                       struct font_point to, bool cubic)
{
    struct font_point p = mapped(pen, a), q = mapped(pen, b), r = mapped(pen, to);
    pen->status = cubic ? font_outline_cubic(pen->outline, p.x, p.y, q.x, q.y, r.x, r.y)
                        : font_outline_quad(pen->outline, p.x, p.y, r.x, r.y);
    pen->turn = cubic ? b : a;
    pen->at = to;
}

static struct font_point across(struct pen *pen, const char *after)
{
    bool goes_on = pen->last == after[0] || pen->last == after[1];
    return goes_on
               ? (struct font_point){2 * pen->at.x - pen->turn.x, 2 * pen->at.y - pen->turn.y}
               : pen->at;
}

/* A command with absolute numbers. */
static void draw(struct pen *pen, char letter, const double *a)
{
    struct font_point p[3] = {{a[0], a[1]}, {a[2], a[3]}, {a[4], a[5]}};
    switch (letter) {
    case 'M': {
        pen->at = pen->from = p[0];
        struct font_point to = mapped(pen, p[0]);
        pen->status = font_outline_move(pen->outline, to.x, to.y);
        break;
    }
    case 'L':
        line_draw(pen, a[0], a[1]);
        break;
    case 'H':
        line_draw(pen, a[0], pen->at.y);
        break;
    case 'V':
        line_draw(pen, pen->at.x, a[0]);
        break;
    case 'C':
        curve_draw(pen, p[0], p[1], p[2], true);
        break;
    case 'S':
        curve_draw(pen, across(pen, "CS"), p[0], p[1], true);
        break;
    case 'Q':
        curve_draw(pen, p[0], p[0], p[1], false);
        break;
    case 'T': {
        struct font_point turn = across(pen, "QT");
        curve_draw(pen, turn, turn, p[0], false);
        break;
    }
    default: /* Z */
        pen->status = font_outline_close(pen->outline);
        pen->at = pen->from;
    }
    pen->last = letter;
}

static const char *gap_pass(const char *at, bool comma)
{
    at += strspn(at, " \t\r\n");
    if (comma && *at == ',')
        at += 1 + strspn(at + 1, " \t\r\n");
    return at;
}

/* SVG's numbers: no names, no hexadecimals. */
static bool number_take(const char **at, double *value)
{
    char *end;
    const char *from = *at, *digit = from + (*from == '-' || *from == '+');
    digit += *digit == '.';
    if (!isdigit((unsigned char)*digit) || (digit[0] == '0' && (digit[1] | 32) == 'x'))
        return false;
    *value = strtod(from, &end);
    *at = end;
    return *value >= -1e7 && *value <= 1e7;
}

enum font_status edits_path_draw(const char *d, const double map[6], struct font_outline *out,
                                 const char **why)
{
    struct pen pen = {.map = map, .outline = out};
    int command = -1;
    bool relative = false;
    *why = NULL;
    for (const char *at = gap_pass(d, false); *at && pen.status == FONT_OK;) {
        double a[6] = {0};
        char letter = (char)toupper((unsigned char)*at);
        if (isalpha((unsigned char)*at)) {
            relative = *at != letter;
            for (command = 0; command < COMMANDS && commands[command].letter != letter;)
                command++;
            at = gap_pass(at + 1, false);
        } else if (command >= 0 && command < COMMANDS && commands[command].count) {
            command += commands[command].letter == 'M'; /* further points are lines to them */
            letter = commands[command].letter;
        } else {
            command = COMMANDS;
        }
        if (command == COMMANDS || (!pen.last && letter != 'M')) {
            *why = letter == 'A' ? "has an arc (A); make it curves"
                                 : "is not made of M, L, H, V, C, S, Q, T and Z, M first";
            return FONT_BAD_FILE;
        }
        for (int i = 0; i < commands[command].count; i++) {
            if (!number_take(&at, &a[i])) {
                *why = "lacks a number, or has one beyond 1e7";
                return FONT_BAD_FILE;
            }
            at = gap_pass(at, true);
            if (relative)
                a[i] += letter == 'V' || (letter != 'H' && i % 2) ? pen.at.y : pen.at.x;
        }
        /* Behind Z the next contour may begin where the last one did. */
        if (pen.last == 'Z' && letter != 'M' && letter != 'Z')
            draw(&pen, 'M', (double[6]){pen.at.x, pen.at.y});
        if (pen.status == FONT_OK)
            draw(&pen, letter, a);
    }
    return pen.status == FONT_OK ? font_outline_close(out) : pen.status;
}
