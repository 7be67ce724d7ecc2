// springs_box2d.cpp - the same network in Box2D, whose interface is C++: see springs_scene.h.
#include <box2d/box2d.h>
#include <cfloat>
#include <new>
#include <vector>

extern "C" {
#include "springs_scene.h"

extern const bool springs_box2d_built;
}

const bool springs_box2d_built = true;

struct springs_box2d {
    b2World world;
    std::vector<b2Body *> bodies;
    explicit springs_box2d(double gravity) : world(b2Vec2(0, float(-gravity)))
    {
    }
};

static void body_add(springs_box2d *p, const springs_mass &m)
{
    b2BodyDef def;
    def.type = m.fixed ? b2_staticBody : b2_dynamicBody;
    def.position.Set(float(m.x), float(m.y));
    def.linearVelocity.Set(float(m.fixed ? 0 : m.vx), float(m.fixed ? 0 : m.vy));
    def.fixedRotation = true;
    def.allowSleep = false;
    b2Body *body = p->world.CreateBody(&def);
    b2MassData mass = {float(m.mass), b2Vec2(0, 0), 0};
    body->SetMassData(&mass);
    p->bodies.push_back(body);
}

springs_box2d *springs_box2d_create(const springs_scene *s)
{
    springs_box2d *p = new (std::nothrow) springs_box2d(s->gravity);
    if (!p)
        return nullptr;
    for (int i = 0; i < s->masses_count; i++)
        body_add(p, s->masses[i]);
    for (int i = 0; i < s->springs_count; i++) {
        const springs_spring &spring = s->springs[i];
        if (s->masses[spring.a].fixed && s->masses[spring.b].fixed)
            continue; // as Chipmunk has it
        b2DistanceJointDef def;
        def.bodyA = p->bodies[size_t(spring.a)];
        def.bodyB = p->bodies[size_t(spring.b)];
        def.length = float(spring.rest_length);
        def.minLength = 0;
        def.maxLength = FLT_MAX;
        def.stiffness = float(spring.constant);
        def.damping = float(spring.damping);
        p->world.CreateJoint(&def);
    }
    return p;
}

void springs_box2d_destroy(springs_box2d *p)
{
    delete p;
}

void springs_box2d_step(springs_box2d *p, double dt_s, int count)
{
    for (; count > 0; count--)
        p->world.Step(float(dt_s), 1, 1);
}

void springs_box2d_state(const springs_box2d *p, int mass, double state[4])
{
    const b2Body *body = p->bodies[size_t(mass)];
    state[0] = double(body->GetPosition().x);
    state[1] = double(body->GetPosition().y);
    state[2] = double(body->GetLinearVelocity().x);
    state[3] = double(body->GetLinearVelocity().y);
}
