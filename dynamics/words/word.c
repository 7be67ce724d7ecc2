/* word.c - letters as masses and springs: see word.h. */
#include "word.h"
#include "word_internal.h"

#include <array.h>
#include <fields.h>
#include <math.h>
#include <patience.h>
#include <quad.h>
#include <stdlib.h>

struct dyn_word_def dyn_word_def_usual(void)
{
    return (struct dyn_word_def){.size = 1, .style = dyn_word_style_usual()};
}

void dyn_word_destroy(struct dyn_word *word)
{
    if (!word)
        return;
    free(word->letters);
    free(word->part);
    free(word);
}

/* ---- presets ---- */

static int longest_line(const struct dyn_word *word)
{
    int most = 0, line = -1, count = 0;
    for (int i = 0; i < word->letters_count; i++) {
        count = word->letters[i].line == line ? count + 1 : 1;
        line = word->letters[i].line;
        most = count > most ? count : most;
    }
    return most;
}

enum dyn_status dyn_preset_fit(const char *name, struct dyn_word_def *def, int *letters)
{
    enum { LETTERS = 9 };
    struct dyn_word word = {.style = def->style};
    struct dyn_place *places;
    if (!dyn_preset_collides(name) && !letters)
        return DYN_OK;
    const enum dyn_status status = dyn_letters_make(&word, def, &places);
    const int longest = longest_line(&word);
    const double part = (double)longest / LETTERS;
    free(places);
    free(word.letters);
    if (status != DYN_OK)
        return status;
    if (dyn_preset_collides(name) && longest < LETTERS)
        def->style.link *= part * part;
    if (letters)
        *letters = longest;
    return DYN_OK;
}

/* ---- springs ---- */

static struct dyn_spring spring_of(const struct dyn_word *word,
                                   const struct dyn_word_style *style, enum dyn_part part)
{
    const double constants[DYN_PARTS_COUNT] = {style->side, style->diagonal, style->link,
                                               style->hang, style->link,     style->hang};
    double breaking = part == DYN_SIDE || part == DYN_DIAGONAL ? style->letter_breaking
                                                               : style->link_breaking;
    double k = constants[part] * (1 + style->carry * (word->lines_count - 1)),
           both = style->letter_mass / 4 / 2; /* two equal masses oscillate with the reduced
                                               * mass, a half */
    struct dyn_spring spring = dyn_spring_usual();
    spring.constant = k;
    spring.damping = 2 * style->damping_ratio * sqrt(k * both);
    spring.breaking_strain = breaking > 0 ? breaking : INFINITY;
    return spring;
}

static enum dyn_status spring_add(struct dyn_word *word, struct dyn_network *n,
                                  enum dyn_part part, int a, int b)
{
    struct dyn_spring spring = spring_of(word, &word->style, part);
    int count = word->range.springs_count;
    if (!array_reserve(&word->part, &word->parts_capacity, count + 1, sizeof *word->part))
        return dyn_fail(DYN_NO_MEMORY, "no memory for a word of %d springs", count);
    spring.end[0] = a;
    spring.end[1] = b;
    enum dyn_status status = dyn_spring_add(n, &spring, NULL);
    if (status != DYN_OK)
        return status;
    word->part[count] = (uint8_t)part;
    word->range.springs_count++;
    return DYN_OK;
}

static enum dyn_status box_springs(struct dyn_word *word, struct dyn_network *n,
                                   const struct dyn_letter *letter)
{
    static const int ends[6][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {1, 3}};
    enum dyn_status status = DYN_OK;
    for (int i = 0; i < 6 && status == DYN_OK; i++)
        status = spring_add(word, n, i < 4 ? DYN_SIDE : DYN_DIAGONAL, letter->mass[ends[i][0]],
                            letter->mass[ends[i][1]]);
    return status;
}

/* The lower corner of the word's letters in that line that is nearest to the mass, and is not
 * `but`; -1: none. */
static int lower_corner(const struct dyn_word *word, const struct dyn_network *n, int line,
                        int mass, int but)
{
    const struct dyn_state *states = dyn_network_states(n);
    double least = INFINITY;
    int next = -1;
    for (int i = 0; i < word->letters_count; i++)
        for (int k = 0; k < 2 && word->letters[i].line == line; k++) {
            const struct dyn_state *s = &states[word->letters[i].mass[k]];
            double far = hypot(s->x - states[mass].x, s->y - states[mass].y);
            if (far < least && word->letters[i].mass[k] != but) {
                least = far;
                next = word->letters[i].mass[k];
            }
        }
    return next;
}

/* The nearest line above that has letters: a line may be empty. */
static int line_above(const struct dyn_word *word, int line)
{
    int above = -1;
    for (int i = 0; i < word->letters_count; i++)
        if (word->letters[i].line < line && word->letters[i].line > above)
            above = word->letters[i].line;
    return above;
}

/* Whether a lower corner of the other letter is above the mass, as the letter stands: within
 * the room between two words. */
static bool is_above(const struct dyn_network *n, const struct dyn_letter *letter, int mass,
                     const struct dyn_letter *other)
{
    const double beside_most = 0.75; /* ems */
    const struct dyn_state *s = dyn_network_states(n), *low = &s[letter->mass[0]],
                           *high = &s[letter->mass[3]];
    const double x = high->x - low->x, y = high->y - low->y, length = hypot(x, y);
    for (int k = 0; k < 2; k++) {
        const struct dyn_state *corner = &s[other->mass[k]];
        const double beside = (corner->x - s[mass].x) * y - (corner->y - s[mass].y) * x;
        if (fabs(beside) <= beside_most * letter->size * length)
            return true;
    }
    return false;
}

/* The line from which a letter's upper corner hangs: the nearest above that has something over
 * it, so that what is below a short line hangs from the one before, and not in a fan from the
 * short line's end. -1: none has. */
static int line_over(const struct dyn_word *word, const struct dyn_network *n,
                     const struct dyn_letter *letter, int mass)
{
    for (int i = (int)(letter - word->letters) - 1; i >= 0; i--)
        if (word->letters[i].line < letter->line &&
            is_above(n, letter, mass, &word->letters[i]))
            return word->letters[i].line;
    return -1;
}

/* Whether springs go across the gaps between letters, and those between lines. */
static bool letters_are_crossed(const struct dyn_word *word)
{
    const enum dyn_brace brace = (enum dyn_brace)(int)word->style.brace;
    return brace == DYN_BRACE_CROSSED || (brace != DYN_BRACE_NONE && word->lines_count > 1);
}

static bool lines_are_crossed(const struct dyn_word *word)
{
    return letters_are_crossed(word) && (int)word->style.brace != DYN_BRACE_LINES;
}

/* Each upper corner of a letter hangs from the nearest corner above; and, where springs are
 * crossed, from the one that is nearest to the letter's other upper corner. What juts out
 * beyond all lines above is held by its own line. A line that has nothing over it at all,
 * `alone`, hangs from the nearest line. */
static enum dyn_status hang_springs(struct dyn_word *word, struct dyn_network *n,
                                    const struct dyn_letter *letter, bool alone)
{
    enum dyn_status status = DYN_OK;
    for (int k = 3; k >= 2 && status == DYN_OK; k--) {
        const int above = alone ? line_above(word, letter->line)
                                : line_over(word, n, letter, letter->mass[k]);
        if (above < 0)
            continue;
        const int corner = lower_corner(word, n, above, letter->mass[k], -1),
                  across = lower_corner(word, n, above, letter->mass[5 - k], corner);
        status = spring_add(word, n, DYN_HANG, corner, letter->mass[k]);
        if (status == DYN_OK && lines_are_crossed(word))
            status = spring_add(word, n, DYN_HANG_BRACE, across, letter->mass[k]);
    }
    return status;
}

/* The letters of a line, which begins with that one, hang from what is over them. Returns the
 * first letter of the next line in *next. */
static enum dyn_status line_hang(struct dyn_word *word, struct dyn_network *n, int first,
                                 int *next)
{
    const int line = word->letters[first].line;
    enum dyn_status status = DYN_OK;
    bool alone = true;
    int end = first;
    for (; end < word->letters_count && word->letters[end].line == line; end++)
        for (int k = 2; k <= 3 && alone; k++)
            alone = line_over(word, n, &word->letters[end], word->letters[end].mass[k]) < 0;
    for (int i = first; i < end && status == DYN_OK; i++)
        status = hang_springs(word, n, &word->letters[i], alone);
    *next = end;
    return status;
}

static enum dyn_status springs_make(struct dyn_word *word, struct dyn_network *n)
{
    enum dyn_status status = DYN_OK;
    word->range.first_spring = dyn_springs_count(n);
    for (int i = 0; i < word->letters_count && status == DYN_OK; i++) {
        const struct dyn_letter *letter = &word->letters[i];
        status = box_springs(word, n, letter);
    }
    for (int i = 0; i + 1 < word->letters_count && status == DYN_OK; i++) {
        struct dyn_letter *a = &word->letters[i];
        const struct dyn_letter *b = a + 1;
        for (int k = 0; k < 2 && a->line == b->line && status == DYN_OK; k++) {
            a->link[k] = dyn_springs_count(n);
            status = spring_add(word, n, DYN_LINK, a->mass[1 + k], b->mass[k ? 3 : 0]);
            if (status == DYN_OK && letters_are_crossed(word))
                status =
                    spring_add(word, n, DYN_LINK_BRACE, a->mass[1 + k], b->mass[k ? 0 : 3]);
        }
    }
    for (int i = 0; i < word->letters_count && status == DYN_OK;) {
        status = line_hang(word, n, i, &i);
        if (status == DYN_OK && patience_over())
            status = dyn_fail(DYN_NO_MEMORY, "stopped");
    }
    return status;
}

/* ---- masses ---- */

static bool is_tacked(const struct dyn_word *word, int letter, int corner)
{
    const struct dyn_letter *l = &word->letters[letter], *last = l + 1;
    int first_line = word->letters[0].line,
        last_line = word->letters[word->letters_count - 1].line;
    bool ends_line = letter + 1 == word->letters_count || last->line != l->line;
    switch ((enum dyn_tack)(int)word->style.tack) {
    case DYN_TACK_NONE:
        return false;
    case DYN_TACK_FIRST:
        return letter == 0 && corner == 3;
    case DYN_TACK_ENDS:
        return l->line == first_line &&
               ((letter == 0 && corner == 3) || (ends_line && corner == 2));
    case DYN_TACK_TOP:
        return l->line == first_line && corner >= 2;
    case DYN_TACK_BOTTOM:
        return l->line == last_line && corner < 2;
    }
    return false;
}

static enum dyn_status masses_make(struct dyn_word *word, struct dyn_network *n,
                                   const struct dyn_word_def *def,
                                   const struct dyn_place *places)
{
    struct dyn_path path = {0};
    enum dyn_status status =
        def->path_count ? dyn_path_make(&path, def->path, def->path_count) : DYN_OK;
    word->range.first_mass = dyn_masses_count(n);
    for (int i = 0; i < word->letters_count && status == DYN_OK; i++) {
        struct dyn_letter *l = &word->letters[i];
        const double corners[4][2] = {
            {l->x0, l->y0}, {l->x1, l->y0}, {l->x1, l->y1}, {l->x0, l->y1}};
        for (int k = 0; k < 4 && status == DYN_OK; k++) {
            struct dyn_place at = {places[i].x + corners[k][0], places[i].y + corners[k][1]};
            at = path.count ? dyn_path_place(&path, at.x, at.y)
                            : (struct dyn_place){def->x + at.x, def->y + at.y};
            struct dyn_mass mass = dyn_mass_usual();
            mass.x = at.x;
            mass.y = at.y;
            mass.mass = word->style.letter_mass / 4;
            mass.hold = is_tacked(word, i, k) ? DYN_STUCK : DYN_FREE;
            status = dyn_mass_add(n, &mass, &l->mass[k]);
        }
    }
    word->range.masses_count = dyn_masses_count(n) - word->range.first_mass;
    dyn_marks_stand(word);
    dyn_path_finish(&path);
    return status;
}

enum dyn_status dyn_word_create(struct dyn_network *n, const struct dyn_word_def *def,
                                struct dyn_word **out)
{
    struct dyn_word *word = calloc(1, sizeof *word);
    struct dyn_place *places = NULL;
    int masses = dyn_masses_count(n), springs = dyn_springs_count(n);
    *out = NULL;
    if (!word)
        return dyn_fail(DYN_NO_MEMORY, "no memory for a word");
    word->style = def->style;
    enum dyn_status status = dyn_letters_make(word, def, &places);
    for (int i = 0; status == DYN_OK && i < word->letters_count; i++)
        word->lines_count += i == 0 || word->letters[i].line != word->letters[i - 1].line;
    if (status == DYN_OK)
        status = masses_make(word, n, def, places);
    if (status == DYN_OK)
        status = springs_make(word, n);
    free(places);
    if (status == DYN_OK) {
        *out = word;
        return DYN_OK;
    }
    dyn_network_truncate(n, masses, springs);
    dyn_word_destroy(word);
    return status;
}

/* ---- what it is ---- */

int dyn_word_letters_count(const struct dyn_word *word)
{
    return word->letters_count;
}

int dyn_word_glyphs_count(const struct dyn_word *word)
{
    return dyn_glyphs(word);
}

const struct dyn_letter *dyn_word_letter(const struct dyn_word *word, int index)
{
    return &word->letters[index];
}

struct dyn_word_range dyn_word_range(const struct dyn_word *word)
{
    return word->range;
}

enum dyn_part dyn_word_part(const struct dyn_word *word, int index)
{
    return (enum dyn_part)word->part[index];
}

void dyn_word_quad(const struct dyn_word *word, const struct dyn_network *n, int index,
                   double corners[4][2])
{
    const struct dyn_state *states = dyn_network_states(n);
    for (int k = 0; k < 4; k++) {
        corners[k][0] = states[word->letters[index].mass[k]].x;
        corners[k][1] = states[word->letters[index].mass[k]].y;
    }
}

int dyn_word_letter_at(const struct dyn_word *word, const struct dyn_network *n, double x,
                       double y, double uv[2])
{
    for (int i = word->letters_count - 1; i >= 0; i--) {
        double corners[4][2], u, v;
        struct dyn_quad_map map;
        dyn_word_quad(word, n, i, corners);
        if (dyn_quad_make(&map, DYN_QUAD_SMOOTH, corners) &&
            dyn_quad_inverse(&map, x, y, &u, &v) && u >= 0 && u <= 1 && v >= 0 && v <= 1) {
            if (uv) {
                uv[0] = u;
                uv[1] = v;
            }
            return i;
        }
    }
    return -1;
}

/* ---- changes ---- */

struct dyn_word_style dyn_word_style_get(const struct dyn_word *word)
{
    return word->style;
}

enum dyn_status dyn_word_style_set(struct dyn_word *word, struct dyn_network *n,
                                   const struct dyn_word_style *style)
{
    enum dyn_status status =
        dyn_controls_check(dyn_word_controls, dyn_word_controls_count, style);
    const struct control *mass = dyn_mass_field_find("mass");
    if (status != DYN_OK)
        return status;
    for (int i = 0; i < word->range.masses_count; i++)
        dyn_mass_write(n, word->range.first_mass + i, mass, style->letter_mass / 4);
    for (int i = 0; i < word->range.springs_count; i++) {
        struct dyn_spring now = dyn_spring_get(n, word->range.first_spring + i);
        struct dyn_spring spring = spring_of(word, style, dyn_word_part(word, i));
        spring.rest_length = now.rest_length;
        spring.broken = now.broken;
        status = dyn_spring_set(n, word->range.first_spring + i, &spring);
        if (status != DYN_OK)
            return status;
    }
    word->style = *style;
    return DYN_OK;
}

enum dyn_status dyn_words_hang(struct dyn_network *n, const struct dyn_word *upper,
                               const struct dyn_word *lower, int *first, int *count)
{
    int last_line = upper->letters[upper->letters_count - 1].line, top = lower->letters[0].line;
    enum dyn_status status = DYN_OK;
    *first = dyn_springs_count(n);
    for (int i = 0; i < lower->letters_count; i++)
        for (int k = 3; k >= 2 && status == DYN_OK && lower->letters[i].line == top; k--) {
            struct dyn_spring spring = spring_of(lower, &lower->style, DYN_HANG);
            spring.end[1] = lower->letters[i].mass[k];
            spring.end[0] = lower_corner(upper, n, last_line, spring.end[1], -1);
            status = dyn_spring_add(n, &spring, NULL);
        }
    *count = dyn_springs_count(n) - *first;
    if (status != DYN_OK)
        dyn_network_truncate(n, dyn_masses_count(n), *first);
    return status;
}
