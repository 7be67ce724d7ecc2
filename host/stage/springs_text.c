/* springs_text.c - the word of springs, and another one in its place while they move. */
#include "springs_internal.h"

#include <math.h>
#include <stdlib.h>

/* The size of the plane in which letters have their boxes. */
static const double plane_size = 100;

/* Converts a word's letter, whose box has y upwards from its origin and corners from the
 * lower left one on. */
static struct stage_springs_letter letter_of(const struct dyn_letter *l)
{
    double scale = plane_size / l->size;
    return (struct stage_springs_letter){
        .letter = {l->face,
                   l->glyph,
                   plane_size,
                   scale * l->x0,
                   -scale * l->y1,
                   scale * l->x1,
                   -scale * l->y0,
                   {0}},
        .masses = {l->mass[3], l->mass[2], l->mass[1], l->mass[0]}};
}

static enum stage_status letters_make(struct springs_text *t,
                                      const struct stage_springs_def *def)
{
    int own = def->letters_count, of_word = t->word ? dyn_word_glyphs_count(t->word) : 0;
    for (int i = 0; i < own; i++)
        for (int k = 0; k < 4; k++)
            if (def->letters[i].masses[k] < 0 ||
                def->letters[i].masses[k] >= dyn_masses_count(def->network))
                return stage_fail(STAGE_BAD_ARGUMENT,
                                  "letter %d stands on mass %d; there are %d", i,
                                  def->letters[i].masses[k], dyn_masses_count(def->network));
    t->letters = calloc((size_t)(own + of_word) + 1, sizeof *t->letters);
    if (!t->letters)
        return stage_fail(STAGE_NO_MEMORY, "no memory for letters");
    for (int i = 0; i < own; i++)
        t->letters[t->letters_count++] = def->letters[i];
    for (int i = 0; i < of_word; i++)
        t->letters[t->letters_count++] = letter_of(dyn_word_letter(t->word, i));
    return springs_strains_make(t, dyn_masses_count(def->network));
}

void springs_text_let(struct springs_text *t)
{
    if (!t || --t->users > 0)
        return;
    dyn_word_destroy(t->word);
    free(t->letters);
    free(t->owners);
    free(t->strains);
    free(t);
}

enum stage_status springs_text_make(const struct stage_springs_def *def,
                                    struct springs_text **out)
{
    struct springs_text *t = calloc(1, sizeof *t);
    *out = NULL;
    if (!t) {
        dyn_word_destroy(def->word);
        return stage_fail(STAGE_NO_MEMORY, "no memory for a word");
    }
    *t = (struct springs_text){.users = 1, .word = def->word, .extent = def->extent};
    const enum stage_status status = letters_make(t, def);
    if (status == STAGE_OK)
        *out = t;
    else
        springs_text_let(t);
    return status;
}

/* ---- another word ----
 *
 * Letters at the beginning that both words have go on as they moved. What follows them is put
 * where it would be if the last of them were a solid body with it, and moves as that one does.
 * Tacks are those of the new word: where they are higher, all of it is raised. */

/* How many letters from the first on are the same. */
static int common_count(const struct dyn_word *a, const struct dyn_word *b)
{
    const int most = dyn_word_letters_count(a) < dyn_word_letters_count(b)
                         ? dyn_word_letters_count(a)
                         : dyn_word_letters_count(b);
    int i = 0;
    for (; i < most; i++) {
        const struct dyn_letter *l = dyn_word_letter(a, i), *m = dyn_word_letter(b, i);
        if (l->face != m->face || l->glyph != m->glyph || l->line != m->line)
            break;
    }
    return i;
}

/* Where the last letter that both words have has gone: turned about its middle, and moved. */
struct carried {
    double from_x, from_y, to_x, to_y, cosine, sine, vx, vy;
};

/* How much a word has to be raised so that no tack is lower than the new word's. */
static double lift_of(const struct springs *s, const struct dyn_network *network,
                      const struct dyn_word *word, int common)
{
    double lift = 0;
    for (int i = 0; i < 4 * common; i++) {
        const int mass = dyn_word_letter(word, i / 4)->mass[i % 4];
        const int old = dyn_word_letter(s->text->word, i / 4)->mass[i % 4];
        if (dyn_mass_get(network, mass).hold & DYN_STUCK)
            lift = fmax(lift,
                        dyn_mass_get(network, mass).y - dyn_network_states(s->network)[old].y);
    }
    return lift;
}

static struct carried carried_of(const struct dyn_state was[4], const struct dyn_state is[4])
{
    struct carried c = {.cosine = 1};
    double along = 0, across = 0;
    for (int k = 0; k < 4; k++) {
        const struct dyn_state *a = &was[k], *b = &was[(k + 1) % 4], *p = &is[k],
                               *q = &is[(k + 1) % 4];
        c.from_x += a->x / 4, c.from_y += a->y / 4, c.to_x += p->x / 4, c.to_y += p->y / 4;
        c.vx += p->vx / 4, c.vy += p->vy / 4;
        along += (b->x - a->x) * (q->x - p->x) + (b->y - a->y) * (q->y - p->y);
        across += (b->x - a->x) * (q->y - p->y) - (b->y - a->y) * (q->x - p->x);
    }
    const double length = hypot(along, across);
    if (length > 0)
        c.cosine = along / length, c.sine = across / length;
    return c;
}

static void mass_carry(const struct carried *c, struct dyn_mass *mass)
{
    const double x = mass->x - c->from_x, y = mass->y - c->from_y;
    if (mass->hold & DYN_STUCK)
        return;
    mass->x = c->to_x + c->cosine * x - c->sine * y;
    mass->y = c->to_y + c->sine * x + c->cosine * y;
    mass->vx = c->vx, mass->vy = c->vy;
}

static enum dyn_status letters_carry(const struct springs *s, struct dyn_network *network,
                                     const struct dyn_word *word)
{
    const int common = common_count(s->text->word, word), count = dyn_word_letters_count(word);
    const double lift = lift_of(s, network, word, common);
    struct carried carried = {.cosine = 1};
    enum dyn_status status = DYN_OK;
    for (int i = 0; i < count && status == DYN_OK; i++) {
        const struct dyn_letter *l = dyn_word_letter(word, i);
        struct dyn_state was[4], is[4];
        for (int k = 0; k < 4 && status == DYN_OK; k++) {
            struct dyn_mass mass = dyn_mass_get(network, l->mass[k]);
            was[k] = (struct dyn_state){mass.x, mass.y, 0, 0};
            if (i < common) {
                is[k] =
                    dyn_network_states(s->network)[dyn_word_letter(s->text->word, i)->mass[k]];
                is[k].y += lift;
                const bool stuck = (mass.hold & DYN_STUCK) != 0;
                mass.x = is[k].x, mass.y = is[k].y;
                mass.vx = stuck ? 0 : is[k].vx, mass.vy = stuck ? 0 : is[k].vy;
            } else {
                mass_carry(&carried, &mass);
            }
            status = dyn_mass_set(network, l->mass[k], &mass);
        }
        if (i == common - 1)
            carried = carried_of(was, is);
    }
    return status;
}

/* The new network has the world and the style of now. */
static enum dyn_status world_carry(const struct springs *s, struct stage_springs_def *def)
{
    enum dyn_status status = dyn_network_world_set(def->network, dyn_network_world(s->network));
    struct dyn_word_style style = s->set.style;
    if (status == DYN_OK)
        status = dyn_word_style_set(def->word, def->network, &style);
    if (status == DYN_OK)
        status = letters_carry(s, def->network, def->word);
    dyn_network_time_set(def->network, dyn_network_time_s(s->network));
    return status;
}

enum stage_status springs_text_set(void *actor, const char *words)
{
    struct springs *s = actor;
    struct stage_springs_def def = {.show_masses = true};
    struct springs_text *text;
    if (!s->maker.make || !s->text->word)
        return stage_fail(STAGE_BAD_ARGUMENT, "these springs have no word");
    if (s->clamps)
        return stage_fail(STAGE_BAD_ARGUMENT,
                          "a script leads masses of this word: it cannot be another one");
    enum stage_status status = s->maker.make(s->maker.context, words, &def);
    if (status != STAGE_OK)
        return status;
    const enum dyn_status carried = world_carry(s, &def);
    if (carried != DYN_OK) {
        dyn_word_destroy(def.word);
        dyn_network_destroy(def.network);
        return springs_fail(carried);
    }
    status = springs_text_make(&def, &text);
    if (status != STAGE_OK) {
        dyn_network_destroy(def.network);
        return status;
    }
    springs_text_let(s->text);
    dyn_network_destroy(s->network);
    s->text = text;
    s->network = def.network;
    s->hand = (struct springs_hand){0};
    return STAGE_OK;
}
