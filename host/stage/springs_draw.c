/* springs_draw.c - draws springs: sides, springs by strain, letters, masses, the hand; from
 * back to front. */
#include "springs_internal.h"

#include <math.h>

struct font_point springs_place(const struct springs *s, int mass, double ahead_s)
{
    const struct dyn_state *at = &dyn_network_states(s->network)[mass];
    return (struct font_point){at->x + at->vx * ahead_s, at->y + at->vy * ahead_s};
}

/* A line along a side of the world, across the whole picture. */
static void sides_draw(const struct springs *s, const struct stage_look *look,
                       struct stage_draw_list *list)
{
    const struct dyn_world *w = dyn_network_world(s->network);
    const struct stage_color color = look->theme->colors[STAGE_COLOR_FLOOR];
    const double width = look->px * look->theme->sizes[STAGE_SIZE_FLOOR_WIDTH];
    const double half = width / 2 / look->view.scale; /* masses touch its edge */
    double x0, y0, x1, y1;
    stage_view_to_world(look->view, -width, look->height_px + width, &x0, &y0);
    stage_view_to_world(look->view, look->width_px + width, -width, &x1, &y1);
    if (w->floor_on != 0)
        stage_draw_line(list, x0, w->floor - half, x1, w->floor - half, width, color);
    if (w->ceiling_on != 0)
        stage_draw_line(list, x0, w->ceiling + half, x1, w->ceiling + half, width, color);
    if (w->left_on != 0)
        stage_draw_line(list, w->left - half, y0, w->left - half, y1, width, color);
    if (w->right_on != 0)
        stage_draw_line(list, w->right + half, y0, w->right + half, y1, width, color);
}

static struct stage_color strain_color(const struct springs *s, const struct stage_look *look,
                                       int spring)
{
    const struct stage_color *c = look->theme->colors;
    double strain = dyn_spring_strain(s->network, spring) / s->set.full_strain;
    return stage_color_mix(
        c[STAGE_COLOR_SPRING],
        c[strain > 0 ? STAGE_COLOR_SPRING_STRETCHED : STAGE_COLOR_SPRING_SQUEEZED],
        fabs(strain));
}

static void strings_draw(const struct springs *s, const struct stage_look *look, double ahead_s,
                         struct stage_draw_list *list)
{
    const double width = look->px * look->theme->sizes[STAGE_SIZE_SPRING_WIDTH];
    for (int i = 0; i < dyn_springs_count(s->network); i++) {
        struct dyn_spring spring = dyn_spring_get(s->network, i);
        if (spring.broken)
            continue;
        struct font_point a = springs_place(s, spring.end[0], ahead_s);
        struct font_point b = springs_place(s, spring.end[1], ahead_s);
        stage_draw_line(list, a.x, a.y, b.x, b.y, width, strain_color(s, look, i));
    }
}

static void letters_draw(const struct springs *s, const struct stage_look *look, double ahead_s,
                         struct stage_draw_list *list)
{
    const bool led = springs_strains_find(s);
    for (int i = 0; i < s->text->letters_count; i++) {
        struct stage_springs_letter l = s->text->letters[i];
        struct font_point corners[4];
        for (int k = 0; k < 4; k++)
            corners[k] = springs_place(s, l.masses[k], ahead_s);
        if (led)
            springs_letter_lead(s, &l);
        stage_draw_letter(list, &l.letter, corners, look->theme->colors[STAGE_COLOR_LETTER]);
    }
}

static const double letter_part = 0.1; /* of an em */

static void masses_draw(const struct springs *s, const struct stage_look *look, double ahead_s,
                        struct stage_draw_list *list)
{
    const struct stage_color *c = look->theme->colors;
    /* beside small letters dots are small, too; a letter's em is 1 */
    const double most = s->text->letters_count ? letter_part * look->view.scale : INFINITY;
    const double radius = fmin(most, look->px * look->theme->sizes[STAGE_SIZE_MASS_RADIUS]);
    for (int i = 0; i < dyn_masses_count(s->network); i++) {
        unsigned held = dyn_mass_get(s->network, i).hold;
        struct font_point at = springs_place(s, i, ahead_s);
        if (held & DYN_HELD)
            stage_draw_disc(list, at.x, at.y, 1.6 * radius, c[STAGE_COLOR_MASS_HELD]);
        else if (held & DYN_STUCK)
            stage_draw_disc(list, at.x, at.y, 1.6 * radius, c[STAGE_COLOR_MASS_STUCK]);
        else if (s->set.show_masses != 0)
            stage_draw_disc(list, at.x, at.y, radius, c[STAGE_COLOR_MASS]);
    }
}

/* Draws the hand's springs, and the stroke of a cut. */
static void hand_draw(const struct springs *s, const struct stage_look *look, double ahead_s,
                      struct stage_draw_list *list)
{
    const struct stage_color *c = look->theme->colors;
    const struct springs_hand *h = &s->hand;
    const double width = look->px * look->theme->sizes[STAGE_SIZE_HAND_WIDTH];
    if (h->mode == SPRINGS_PULL || h->mode == SPRINGS_LETTER)
        for (int i = 0; i < h->masses_count; i++) {
            struct font_point at = springs_place(s, h->masses[i], ahead_s);
            stage_draw_line(list, at.x, at.y, h->x + h->away_x[i], h->y + h->away_y[i], width,
                            c[STAGE_COLOR_HAND]);
        }
    if (h->mode == SPRINGS_CUT)
        stage_draw_line(list, h->from_x, h->from_y, h->x, h->y,
                        look->px * look->theme->sizes[STAGE_SIZE_CUT_WIDTH],
                        c[STAGE_COLOR_CUT]);
}

void springs_draw(void *actor, const struct stage_look *look, struct stage_draw_list *list)
{
    const struct springs *s = actor;
    double ahead_s = look->fraction * look->step_s;
    sides_draw(s, look, list);
    if (s->set.show_springs != 0)
        strings_draw(s, look, ahead_s, list);
    if (s->set.show_letters != 0)
        letters_draw(s, look, ahead_s, list);
    masses_draw(s, look, ahead_s, list);
    hand_draw(s, look, ahead_s, list);
}
