/* thesis_oracle.c - see thesis_oracle.h. Source: the thesis, appendix 7.1, operation by
 * operation. */
#include "thesis_oracle.h"

#include <math.h>
#include <stdbool.h>

static void mass_force(const struct thesis_params *p, struct thesis_mass *m)
{
    if (m->Wy > 0.5)
        m->ForceY -= p->gravity * m->mass;
    m->ForceX -= m->VelX * p->damping;
    m->ForceY -= m->VelY * p->damping;
}

static void mass_move(const struct thesis_params *p, struct thesis_mass *m,
                      void (*clank)(int velocity))
{
    double dt = p->dTime;
    m->AccelX = m->ForceX / m->mass;
    m->AccelY = m->ForceY / m->mass;
    m->VelX += m->AccelX * dt;
    m->VelY += m->AccelY * dt;
    if (m->Wy < 0.5 && m->VelY < 0.0) {
        m->VelY = -(p->floor) * m->VelY;
        if (m->VelY > 0.2) {
            int loud = (int)(m->VelY * 20);
            clank(loud > 127 ? 127 : loud);
        }
    }
    m->Wx += m->VelX * dt + 0.5 * m->AccelX * dt * dt;
    m->Wy += m->VelY * dt + 0.5 * m->AccelY * dt * dt;
}

void thesis_step_oracle(const struct thesis_params *p, struct thesis_mass *masses,
                        struct thesis_spring *springs, void (*clank)(int velocity))
{
    for (int i = 0; i < p->springs; i++) {
        struct thesis_spring *s = &springs[i];
        s->ForceX = cos(s->Theta) * s->k * (s->Distance - s->rest_length);
        s->ForceY = sin(s->Theta) * s->k * (s->Distance - s->rest_length);
    }
    for (int i = 0; i < p->masses; i++)
        masses[i].ForceX = masses[i].ForceY = 0.0;
    for (int i = 0; i < p->springs; i++)
        for (int end = 0; end < 2; end++) {
            struct thesis_mass *m = &masses[springs[i].end[end]];
            if (m->sticky && p->selected == springs[i].end[end])
                continue;
            m->ForceX += end ? springs[i].ForceX : -springs[i].ForceX;
            m->ForceY += end ? springs[i].ForceY : -springs[i].ForceY;
        }
    for (int i = 0; i < p->masses; i++) {
        struct thesis_mass *m = &masses[i];
        bool selected = p->selected == i;
        if (!m->sticky || !selected)
            mass_force(p, m);
        if (m->sticky || selected)
            m->AccelX = m->AccelY = m->VelX = m->VelY = 0.0;
        else
            mass_move(p, m, clank);
    }
}
