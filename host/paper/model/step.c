/* step.c - one step of time on a sheet: the thesis's page by its own rule (thesis/cycle.c), a
 * sheet with layers by model/film.c.
 *
 * A fiber of a sheet with layers holds water and pigments in up to three of them:
 *
 *        surface_water, surface[i]        flows over the paper            film.c
 *          | absorption      |   ^
 *          v                 |   | lifting                                soak.c
 *        water, infused[i]   |   |        creeps from fiber to fiber      capillary.c
 *            |  ^            v   |
 *            v  |          fixed[i]       stays
 *
 * First comes what happens in each fiber by itself, then what flows over faces, from the state
 * that this left. A flow is computed once for each face, that between a fiber and its upper
 * neighbour on the axis:
 *
 *          x-1          x          x+1
 *       +--------+--------+--------+      out: part of x's that goes up    (0 or more)
 *       |      F(x-1)    F(x)      |      in:  part of x+1's that comes down (0 or less)
 *       +--------+--------+--------+      F = whole grains of out * q(x) + in * q(x+1)
 *
 *       q(x) += F(x-1) - F(x)
 *
 * Grains are rounded, and still no fiber gives more than it has: film.c and capillary.c say
 * why. Amounts are whole numbers up to 2^24, so sums are exact. That amounts stay there is seen
 * to by `room` (flow.c): it is 1 where a fiber is loaded with up to half of SHEET_LOAD_MAX and
 * falls to 0 at that. A mirrored sheet gives mirrored bits, for every expression is symmetric
 * in a face's two sides.
 *
 * What waits to be computed holds the arrays that it is made of, and what neighbours look at
 * may have to be stored. Of a whole step that can be twice what the sheet itself takes. So a
 * step of a large sheet is computed in three parts, one after the other: after soak.c, after
 * film.c, and at its end. Between them only seven terms are alive. That takes a little time, as
 * these are stored, and changes no bit.
 *
 * Sources: Small 1991 (displacement by gravity, absorption, evaporation); Curtis et al. 1997
 * (wet area, edge darkening, transfer of pigment, capacities). */
#include "model/model.h"

struct paper_air paper_air_default(void)
{
    return (struct paper_air){
        .spread = 1,
        .relief = 0.05,
        .film = 0.02,
        .pinning = 0.8,
        .absorption = 0.02,
        .carry = 0.3,
        .humidity = 0.0004,
        .edge = 15,
        .edge_width = 8,
        .settling = 0.1,
        .thesis = paper_weather_default(),
    };
}

/* A field that is overwritten before it is read is a temporary for the machine, and stays an
 * expression that holds the arrays of its operands. Terms are none where a part of a step gets
 * them from the part before: they are read first. */
static void terms_read(struct paper_sheet *p)
{
    for (int i = 0; sheet_parted(p) && i < SHEET_TERMS; i++)
        kit_f_copy(p->t[0], p->term[i]);
}

static void terms_clear(struct paper_sheet *p)
{
    for (int i = 0; i < SHEET_TERMS; i++)
        kit_f_set(p->term[i], 0.0);
}

void sheet_step_everywhere(struct paper_sheet *p)
{
    CM_set_context();
    if (p->config.parts == 0) {
        double weights[PAPER_PIGMENTS_MAX];
        for (int i = 0; i < p->config.pigments_count; i++)
            weights[i] = p->config.pigments[i].weight[0];
        paper_cycle(&p->page, &p->air.thesis, p->infused, weights, p->config.pigments_count);
        return;
    }
    terms_read(p);
    sheet_film_step(p);
    terms_clear(p);
    if (p->salted)
        sheet_salt_step(p);
    sheet_temporaries_clear(p);
    sheet_step_part_end(p);
}
