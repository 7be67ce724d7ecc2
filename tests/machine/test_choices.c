/* test_choices.c - what a large plan stores is chosen in a thread, while the plan is
 * interpreted. Whenever the choice comes, the bits are those of a machine that does everything
 * itself. Machines may end, and children begin, while the thread is at work. */
#include "support.h"

#include <sys/wait.h>
#include <unistd.h>

#include "plans/plans.h"

enum { FIELDS = 10, SIDE = 64, CALLS = 1500, TURNS_MOST = 4000 };

struct calls {
    struct machine *m;
    uint32_t fields[FIELDS];
};

static const struct machine_type word = {MACHINE_BITS, 32, 0, 0};

static void begin(struct calls *p, const char *background)
{
    setenv("LUTETIA_INTERPRET", "1", 1);
    setenv("LUTETIA_BACKGROUND", background, 1);
    p->m = support_machine(0);
    assert_true(support_set(p->m, 2, SIDE, SIDE) > 0);
    for (uint64_t i = 0; i < FIELDS; i++)
        p->fields[i] = support_field(p->m, word, i);
}

static void store(struct calls *p, uint32_t field, struct machine_value *v)
{
    assert_ok(machine_field_store(p->m, field, v, MACHINE_EVERYWHERE), p->m);
    machine_begin(p->m);
}

static uint32_t next(uint32_t *chance, uint32_t below)
{
    *chance = *chance * 1664525 + 1013904223;
    return (*chance >> 16) % below;
}

/* The same calls each time: a thousand sums and neighbours. Then a look. */
static uint64_t turn(struct calls *p)
{
    uint32_t chance = 7;
    for (int i = 0; i < CALLS; i++) {
        struct machine_value *a = support_value(p->m, p->fields[next(&chance, FIELDS)], word);
        struct machine_value *b = support_value(p->m, p->fields[next(&chance, FIELDS)], word);
        uint32_t to = p->fields[next(&chance, FIELDS)];
        if (next(&chance, 3) == 0)
            store(p, to, machine_shift(p->m, a, (int)next(&chance, 2), i % 2 ? 1 : -1));
        else
            store(p, to, machine_binary(p->m, i % 3 ? MACHINE_ADD : MACHINE_XOR, a, b));
    }
    struct machine_scalar read;
    assert_ok(machine_field_read(p->m, p->fields[3], word, 77, &read), p->m);
    machine_begin(p->m);
    return read.lo;
}

/* Turns until a thread is at work; how many. */
static int until_choosing(struct calls *p)
{
    int turns = 0;
    while (!p->m->plans->choosing.plan && turns++ < TURNS_MOST)
        turn(p);
    assert_true(turns < TURNS_MOST);
    return turns;
}

static void bits_are_the_same_whenever_the_choice_comes(void **state)
{
    struct calls with, without;
    int turns = 0;
    (void)state;
    begin(&with, "1");
    begin(&without, "0");
    turns = until_choosing(&with);
    for (int i = 0; i < turns; i++)
        turn(&without);
    for (; with.m->plans->choosing.plan && turns < TURNS_MOST; turns++)
        assert_int_equal(turn(&with), turn(&without));
    assert_true(turns < TURNS_MOST);
    assert_null(without.m->plans->choosing.plan);
    for (int i = 0; i < 20; i++)
        assert_int_equal(turn(&with), turn(&without));
    support_machine_destroy(with.m);
    support_machine_destroy(without.m);
}

static void a_machine_ends_meanwhile(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct calls p;
        begin(&p, "1");
        until_choosing(&p);
        support_machine_destroy(p.m);
    }
}

static void a_child_does_not_wait_for_it(void **state)
{
    struct calls p;
    int status = 1;
    (void)state;
    begin(&p, "1");
    until_choosing(&p);
    pid_t child = fork();
    if (child == 0)
        _exit(choice_is_awaited(p.m) || p.m->plans->choosing.plan);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    turn(&p);
    support_machine_destroy(p.m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_are_the_same_whenever_the_choice_comes),
        cmocka_unit_test(a_machine_ends_meanwhile),
        cmocka_unit_test(a_child_does_not_wait_for_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
