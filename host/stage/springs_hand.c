/* springs_hand.c - handles the pointer: see springs.h and the drawing in springs_internal.h. */
#include "springs_internal.h"

#include <hand.h>
#include <input.h>

#include <math.h>

/* A pen pressed harder than this tacks masses. */
static const double tack_pressure = 0.75;

/* Twice the area of a triangle, positive if it goes round to the left. */
static double turn(struct font_point a, struct font_point b, double x, double y)
{
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/* The letter between whose masses a point lies: of several the one drawn last; -1: none. */
static int letter_at(const struct springs *s, double x, double y)
{
    for (int i = s->text->letters_count - 1; i >= 0; i--) {
        int winding = 0;
        for (int k = 0; k < 4; k++) {
            struct font_point a = springs_place(s, s->text->letters[i].masses[k], 0);
            struct font_point b = springs_place(s, s->text->letters[i].masses[(k + 1) % 4], 0);
            if (a.y <= y && b.y > y && turn(a, b, x, y) > 0)
                winding++;
            else if (a.y > y && b.y <= y && turn(a, b, x, y) < 0)
                winding--;
        }
        if (winding)
            return i;
    }
    return -1;
}

static void pulls_move(struct springs *s)
{
    const struct springs_hand *h = &s->hand;
    for (int i = 0; i < h->masses_count; i++)
        dyn_pull_move(s->network, h->masses[i], h->x + h->away_x[i], h->y + h->away_y[i]);
}

/* Moves the mass to the pointer at once. */
static void hold(struct springs *s)
{
    s->hand.mode = SPRINGS_HOLD;
    dyn_mass_hold(s->network, s->hand.masses[0], s->hand.x, s->hand.y);
}

static bool mass_take(struct springs *s, int mass, const struct stage_event *e)
{
    struct springs_hand *h = &s->hand;
    bool stuck = (dyn_mass_get(s->network, mass).hold & DYN_STUCK) != 0;
    bool shift = (e->modifiers & INPUT_SHIFT) != 0;
    h->masses[0] = mass;
    h->masses_count = 1;
    h->untack = stuck && shift;
    if (stuck || shift || e->pressure > tack_pressure) {
        if (!h->untack)
            hold(s);
        else
            h->mode = SPRINGS_HOLD;
        return true;
    }
    h->mode = SPRINGS_PULL;
    return dyn_pull_begin(s->network, mass, e->x, e->y, s->set.hand) == DYN_OK;
}

/* Pulls the letter's masses, each with a fourth of the hand's stiffness. */
static bool letter_take(struct springs *s, int letter, const struct stage_event *e)
{
    struct springs_hand *h = &s->hand;
    h->mode = SPRINGS_LETTER;
    for (int k = 0; k < 4; k++) {
        struct font_point at = springs_place(s, s->text->letters[letter].masses[k], 0);
        int mass = s->text->letters[letter].masses[k];
        if (dyn_pull_begin(s->network, mass, at.x, at.y, s->set.hand / 4) != DYN_OK)
            continue;
        h->away_x[h->masses_count] = at.x - e->x;
        h->away_y[h->masses_count] = at.y - e->y;
        h->masses[h->masses_count++] = mass;
    }
    return h->masses_count > 0;
}

static bool press(struct springs *s, const struct stage_event *e)
{
    int mass = dyn_network_nearest(s->network, e->x, e->y, e->near);
    s->hand = (struct springs_hand){.button = e->button,
                                    .x = e->x,
                                    .y = e->y,
                                    .near = e->near,
                                    .from_x = e->x,
                                    .from_y = e->y};
    bool taken = false;
    if (e->button == INPUT_BUTTON_RIGHT) {
        s->hand.mode = SPRINGS_CUT;
        taken = true;
    } else if (e->button == INPUT_BUTTON_LEFT && mass >= 0) {
        taken = mass_take(s, mass, e);
    } else if (e->button == INPUT_BUTTON_LEFT) {
        int letter = letter_at(s, e->x, e->y);
        taken = letter >= 0 && letter_take(s, letter, e);
    }
    if (!taken)
        s->hand = (struct springs_hand){0};
    return taken;
}

static void move(struct springs *s, const struct stage_event *e)
{
    struct springs_hand *h = &s->hand;
    double before_x = h->x, before_y = h->y;
    int cut;
    h->x = e->x;
    h->y = e->y;
    h->moved = h->moved || hypot(e->x - h->from_x, e->y - h->from_y) > h->near / 3;
    switch (h->mode) {
    case SPRINGS_PULL:
        if ((e->modifiers & INPUT_SHIFT) || e->pressure > tack_pressure) {
            dyn_pull_end(s->network, h->masses[0]);
            hold(s);
        } else {
            pulls_move(s);
        }
        break;
    case SPRINGS_LETTER:
        pulls_move(s);
        break;
    case SPRINGS_HOLD:
        if (!h->untack || h->moved)
            hold(s);
        break;
    case SPRINGS_CUT:
        dyn_network_cut(s->network, before_x, before_y, e->x, e->y, &cut);
        break;
    case SPRINGS_NONE:
        break;
    }
}

/* ---- the hand as a script ---- */

enum { KEYS_PER_S = 30 };

enum dyn_status springs_record(struct springs *s)
{
    double now_s = dyn_network_time_s(s->network);
    bool late = now_s >= s->recorded_s + 1.0 / KEYS_PER_S || now_s < s->recorded_s;
    if (s->hand.mode != SPRINGS_HOLD || (s->recorded && !late))
        return DYN_OK;
    enum dyn_status status = s->recorded ? DYN_OK : dyn_clamps_create(&s->recorded);
    s->recorded_s = now_s;
    if (status == DYN_OK)
        status = dyn_clamps_key(s->recorded, s->hand.masses[0], now_s, s->hand.x, s->hand.y);
    return status;
}

/* Adds the last key of a mass that was held: the place where it stays, or from which it
 * moves freely. */
static void record_end(struct springs *s)
{
    const struct springs_hand *h = &s->hand;
    double now_s = dyn_network_time_s(s->network);
    if (s->set.record_hand == 0 || !s->recorded)
        return;
    if (dyn_mass_get(s->network, h->masses[0]).hold & DYN_STUCK)
        dyn_clamps_key(s->recorded, h->masses[0], now_s, h->x, h->y);
    else
        dyn_clamps_free(s->recorded, h->masses[0], now_s);
}

static void let_go(struct springs *s, bool tacking)
{
    struct springs_hand *h = &s->hand;
    if (h->mode == SPRINGS_PULL || h->mode == SPRINGS_LETTER)
        for (int i = 0; i < h->masses_count; i++)
            dyn_pull_end(s->network, h->masses[i]);
    if (h->mode == SPRINGS_HOLD) {
        bool untack = tacking && h->untack && !h->moved;
        if (untack)
            dyn_mass_untack(s->network, h->masses[0]);
        else if (tacking)
            dyn_mass_tack(s->network, h->masses[0]);
        dyn_mass_release(s->network, h->masses[0]);
        record_end(s);
    }
    *h = (struct springs_hand){0};
}

bool springs_event(void *actor, const struct stage_event *e)
{
    struct springs *s = actor;
    switch (e->kind) {
    case STAGE_POINTER_DOWN:
        return s->hand.mode == SPRINGS_NONE && press(s, e);
    case STAGE_POINTER_MOVE:
        move(s, e);
        return true;
    case STAGE_POINTER_UP:
        if (e->button != s->hand.button)
            return true;
        move(s, e);
        let_go(s, true);
        return true;
    case STAGE_POINTER_CANCEL:
        let_go(s, false);
        return true;
    }
    return false;
}
