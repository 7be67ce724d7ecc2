/* breaks.h - where a paragraph's lines end: the way through its legal ends with the fewest
 * demerits, after Knuth and Plass (Breaking Paragraphs into Lines, 1981). Pure: it knows
 * nothing of type.
 *
 * A line from the place a to the place b is b.end - a.next wide, and can stretch and shrink by
 * as much as the sums say. Its ratio r is what it lacks by what it can stretch, or what it has
 * too much by what it can shrink; its badness 100 |r|^3. */
#ifndef LUTETIA_PAGE_BREAKS_H
#define LUTETIA_PAGE_BREAKS_H

#include <stdbool.h>
#include <stdint.h>

struct break_sum {
    double px, stretch, shrink;
};

struct break_place {
    struct break_sum
        end; /* up to here, without white space, with the hyphen that is then seen */
    struct break_sum next; /* where the line after it begins */
    double penalty;        /* what it costs to break here; negative: what it earns */
    bool flagged;          /* at a hyphen: two in a row cost more */
};

struct break_rules {
    double tolerance;    /* the badness that a line may have */
    double emergency_px; /* stretch that each line has besides */
    bool last_fills;     /* the last line need not reach the end */
    int ladder_max;      /* so many flagged ends in a row at most; 0: any number */
    double runt_px;      /* a last line that is shorter costs, as one that is loose; 0: none */
    /* a last line that is but the rest of a word is taken only where there is no other way */
    bool whole_word;
    /* where no line is good enough, one that is too long is taken; else breaks_find() fails */
    bool must;
};

enum { BREAK_INFINITE = 10000, BREAK_OVERFULL = 1 << 20, BREAK_REST_DEMERITS = 1000000000 };

enum { BREAK_DECENT = 2, BREAK_TIGHT = 3 }; /* fitnesses */

/* places[0] is the paragraph's beginning (its `next` counts) and the last one its end. widths:
 * of lines, the last for all after it. chosen: room for as many as there are places; gets the
 * places where lines end, places[0] left out. *count: how many; 0 if the rules cannot be kept.
 * *demerits (may be NULL): of the whole. False: no memory, or it shall stop (patience.h). */
bool breaks_find(const struct break_place *places, int places_count, const double *widths,
                 int widths_count, const struct break_rules *rules, int *chosen, int *count,
                 double *demerits);

/* ---- a way that is found again after a change ----
 *
 * Sums of places must be exact (breaks_exact), so that they differ by as much whatever stands
 * before them: then what is found again is what would be found anew. */

/* A node is a way to break the text up to a place: the best one of those that end there after
 * so many lines with a last line of that fitness. It is active while a line from it can still
 * end at the place that is looked at. */
struct break_node {
    int place, before; /* before: a node's number */
    int gone;          /* the place at which it was active for the last time */
    int line;          /* lines beyond the last width are alike: they have one number */
    int8_t fitness, ladder;
    double demerits;
};

/* Before a place was looked at there were so many nodes; none before the oldest was active. */
struct break_check {
    int place, nodes, oldest;
};

/* A search that has been made. */
struct break_search {
    struct break_node *nodes; /* in the order of their places */
    int count, capacity;
    struct break_check *checks;
    int checks_count, checks_capacity;
    int stopped; /* the place behind which no node was active */
    bool made;
};
void break_search_finish(struct break_search *s); /* it may be made again */

/* Places begin..end_before are others now, begin..end, and all behind them are moved. */
struct break_change {
    int begin, end_before, end;
};

/* breaks_find() after such a change of what *search was made for, by the same rules and widths;
 * NULL, or a search that is not made: from the beginning. chosen: *count of them, the caller
 * frees it; NULL if there is no way. */
bool breaks_find_again(const struct break_place *places, int places_count, const double *widths,
                       int widths_count, const struct break_rules *rules,
                       struct break_search *search, const struct break_change *change,
                       int **chosen, int *count, double *demerits);

/* The whole number nearest to one below 2^51, as rint() has it: that is a call. */
static inline double breaks_whole(double number)
{
    const double shift = 0x1.8p52;
    return number + shift - shift;
}

/* A length as whole parts of a pixel of which all sums are exact up to 2^26 pixels. */
static inline double breaks_exact(double px)
{
    const double parts = 1 << 27;
    return breaks_whole(px * parts) / parts;
}

/* A line's ratio; its stretch may be 0. */
double breaks_ratio(const struct break_place *from, const struct break_place *to, double width,
                    const struct break_rules *rules, bool last);
/* What a line costs after one with that fitness. */
double breaks_demerits(const struct break_place *from, const struct break_place *to,
                       double ratio, int fitness_before, int *fitness, bool last);

#endif
