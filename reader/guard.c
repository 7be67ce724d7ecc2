/* guard.c - what cmark-gfm would take hours or much memory for. Some of its rules look at a
 * whole paragraph for each of its signs (cmark-gfm 0.29.0.gfm.6: tables, addresses of mail,
 * HTML that never ends, blank lines in deep lists), and each link has a copy of its
 * definition. So that work is estimated from the source's lines before it reads them. A
 * document that is written to be read is thousands of times below what is refused. */
#include "reader_internal.h"

#include <ctype.h>
#include <string.h>

static const double WORK_MOST = 4e9; /* about as many nanoseconds */
static const double COPIES_MOST = 512e6;

/* What steps take, in nanoseconds; measured. */
static const double LEVEL_NS = 3, CELL_NS = 1000, CELL_PAIR_NS = 4, ROW_PAIR_NS = 13,
                    MAIL_NS = 2, HTML_NS = 1;

struct guard {
    const char *at, *end; /* the line */
    int line;
    bool blank_before;
    double nested; /* levels of lists and quotes, at most */
    /* Of the lines since the last blank one: */
    double cells, columns, bytes, html;
    bool in_definition, is_note;
    double definition, longest; /* bytes of a link's definition so far; of the longest one */
    int longest_line;
    double brackets, work;
};

/* Behind the name of a note, "[^name]:"; NULL: there is none. */
static const char *name_end(const struct guard *g, const char *at)
{
    if (g->end - at < 4 || at[0] != '[' || at[1] != '^')
        return NULL;
    const char *close = memchr(at, ']', (size_t)(g->end - at));
    return close && close + 1 < g->end && close[1] == ':' ? close + 2 : NULL;
}

/* Signs of lists, quotes and notes, and blanks, that a line begins with. */
static void prefix_read(const struct guard *g, double *marks, double *prefix)
{
    const char *at = g->at, *named;
    *marks = 0;
    for (; at < g->end; at = named ? named : at + 1) {
        named = name_end(g, at);
        if (!named && !(*at && strchr(" \t>*+-.)", *at)) && !isdigit((unsigned char)*at))
            break;
        *marks += named || strchr(">*+-.)", *at);
    }
    *prefix = (double)(at - g->at);
}

static void nesting_add(struct guard *g, bool blank)
{
    double marks, prefix;
    prefix_read(g, &marks, &prefix);
    if (!blank) {
        if (prefix == 0 && g->blank_before)
            g->nested = 0;
        const double deep = g->nested + marks < prefix ? g->nested + marks : prefix;
        g->nested = deep > g->nested ? deep : g->nested;
    }
    g->work += LEVEL_NS * g->nested;
}

/* The line under a table's head, or what looks like it. */
static bool is_delimiter(const struct guard *g)
{
    bool dash = false, sign = false;
    for (const char *at = g->at; at < g->end; at++) {
        if (!strchr("|:-> \t\r", *at))
            return false;
        dash = dash || *at == '-';
        sign = sign || *at == '|' || *at == ':';
    }
    return dash && sign;
}

static void table_add(struct guard *g)
{
    double pipes = 1;
    for (const char *at = g->at; at < g->end; at++)
        pipes += *at == '|';
    g->cells += pipes;
    if (is_delimiter(g)) {
        g->columns = pipes > g->columns ? pipes : g->columns;
        g->work += CELL_PAIR_NS * g->cells * g->cells;
    } else if (g->columns > 0) {
        g->work += CELL_NS * g->columns + ROW_PAIR_NS * pipes * pipes;
    }
}

static void definition_add(struct guard *g, const char *at)
{
    const char next = at + 1 < g->end ? at[1] : '\n';
    if (*at == '[') {
        g->brackets++;
        g->is_note = next == '^';
    }
    if (*at == ']' && next == ':') {
        g->in_definition = !g->is_note;
        g->definition = 0;
    }
    g->definition += g->in_definition;
    if (g->definition > g->longest) {
        g->longest = g->definition;
        g->longest_line = g->line;
    }
}

static void letters_add(struct guard *g)
{
    double mails = 0; /* each is looked for from each of its letters on */
    for (const char *at = g->at; at < g->end; at++) {
        mails = *at == ' ' || *at == '\t' ? 0 : mails + (*at == '@');
        g->work += MAIL_NS * mails;
        g->html += *at == '<' && at + 1 < g->end && (at[1] == '?' || at[1] == '!');
        definition_add(g, at);
    }
}

static void line_add(struct guard *g)
{
    bool blank = true;
    for (const char *at = g->at; at < g->end && blank; at++)
        blank = strchr(" \t>", *at) != NULL;
    nesting_add(g, blank);
    if (blank) {
        g->cells = g->columns = g->bytes = g->html = 0;
        g->in_definition = false;
    } else {
        const double before = g->bytes * g->html;
        g->bytes += (double)(g->end - g->at);
        table_add(g);
        letters_add(g);
        g->work += HTML_NS * (g->bytes * g->html - before);
    }
    g->blank_before = blank;
}

/* The end of a line, and where the next one begins. */
static const char *line_end(const char *at, const char *stop, const char **next)
{
    while (at < stop && *at != '\n' && *at != '\r')
        at++;
    *next = at < stop ? at + 1 : stop;
    if (at + 1 < stop && at[0] == '\r' && at[1] == '\n')
        *next = at + 2;
    return at;
}

enum reader_status reader_guard_check(const char *source, int bytes)
{
    struct guard g = {.blank_before = true};
    const char *next = source, *const stop = source + bytes;
    while (next < stop) {
        g.line++;
        g.at = next;
        g.end = line_end(g.at, stop, &next);
        line_add(&g);
        if (g.work > WORK_MOST)
            return reader_fail(READER_TOO_LARGE,
                               "line %d: too much in one another for a document (lists and "
                               "quotes, cells of tables, signs @ or < in one word or "
                               "paragraph): part it by blank lines or into several files",
                               g.line);
    }
    if (g.longest * g.brackets > COPIES_MOST)
        return reader_fail(READER_TOO_LARGE,
                           "line %d: a link's definition of %.0f KB is too long for a document "
                           "with %.0f brackets: shorten it",
                           g.longest_line, g.longest / 1000, g.brackets);
    return READER_OK;
}
