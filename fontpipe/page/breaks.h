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

/* places[0] is the paragraph's beginning (its `next` counts) and the last one its end. widths:
 * of lines, the last for all after it. chosen: room for as many as there are places; gets the
 * places where lines end, places[0] left out. *count: how many; 0 if the rules cannot be kept.
 * *demerits (may be NULL): of the whole. False: no memory, or it shall stop (patience.h). */
bool breaks_find(const struct break_place *places, int places_count, const double *widths,
                 int widths_count, const struct break_rules *rules, int *chosen, int *count,
                 double *demerits);

/* A line's ratio; its stretch may be 0. */
double breaks_ratio(const struct break_place *from, const struct break_place *to, double width,
                    const struct break_rules *rules, bool last);
/* What a line costs after one with that fitness. */
double breaks_demerits(const struct break_place *from, const struct break_place *to,
                       double ratio, int fitness_before, int *fitness, bool last);

#endif
