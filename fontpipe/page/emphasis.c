/* emphasis.c - see emphasis.h. */
#include "emphasis.h"

#include <ctype.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\n' || c == '\t';
}

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || (unsigned char)c >= 0x80;
}

int emphasis_run(const char *s, int at, int end)
{
    int n = 0;
    while (at + n < end && s[at + n] == s[at])
        n++;
    return n;
}

/* A run of stars may open what it stands before, and close what it stands behind; one of lines
 * (_) not within a word. */
static bool may_open(const char *s, int at, int run, int end)
{
    char sign = s[at];
    return at + run < end && !is_blank(s[at + run]) &&
           !(sign == '_' && at > 0 && is_word(s[at - 1]));
}

static bool may_close(const char *s, int from, int at, int run, int end)
{
    char sign = s[at];
    return at > from && !is_blank(s[at - 1]) &&
           !(sign == '_' && at + run < end && is_word(s[at + run]));
}

/* Whether a run that closes it comes. */
static bool is_closed(const char *s, int from, int end, char sign, int run)
{
    for (int at = from; at < end; at++) {
        if (s[at] == '\\') {
            at++;
        } else if (s[at] == sign) {
            int n = emphasis_run(s, at, end);
            if (n >= run && may_close(s, from, at, n, end))
                return true;
            at += n - 1;
        }
    }
    return false;
}

int emphasis_take(const char *s, int from, int at, int end, struct emphasis *e)
{
    int run = emphasis_run(s, at, end), n = run > 3 ? 3 : run;
    bool slanted = n != 2, heavy = n >= 2;
    if (may_close(s, from, at, run, end)) {
        if (n == 3 && !(e->slanted && e->heavy))
            n = e->heavy ? 2 : 1;
        else if (n == 2 && !e->heavy)
            n = 1;
        slanted = n != 2;
        heavy = n >= 2;
        if ((!slanted || e->slanted) && (!heavy || e->heavy)) {
            e->slanted = e->slanted && !slanted;
            e->heavy = e->heavy && !heavy;
            return n;
        }
        n = run > 3 ? 3 : run;
        slanted = n != 2;
        heavy = n >= 2;
    }
    if (!may_open(s, at, run, end) || !is_closed(s, at + run, end, s[at], n) ||
        (slanted && e->slanted) || (heavy && e->heavy))
        return 0;
    e->slanted = e->slanted || slanted;
    e->heavy = e->heavy || heavy;
    return n;
}
