/* test_threads.c - several threads use a machine each at the same time, and get the results of
 * a thread that is alone. A build with -Db_sanitize=thread finds what they share. */
#include "support.h"

#include "plans/plans.h"

#include <pthread.h>
#include <unistd.h>

enum { THREADS = 3, HEIGHT = 48, WIDTH = 80, COUNT = HEIGHT * WIDTH, TURNS = 40 };

struct result {
    uint32_t numbers[COUNT];
    uint64_t sum;
    uint64_t foreseen; /* foreseen calls; with background: kernels from the background */
    char error[200];   /* "": none */
};

static const char *trace_path; /* NULL: none */
static int times = 3;          /* how often a thread makes a machine */
static bool background;

struct sheet {
    struct machine *m;
    uint32_t a, b;
};

static struct machine_value *word(const struct sheet *s, uint32_t field)
{
    return machine_field_value(s->m, field, MACHINE_UINT(32), MACHINE_EVERYWHERE);
}

static bool turn(const struct sheet *s)
{
    struct machine *m = s->m;
    struct machine_value *x = word(s, s->a);
    for (int axis = 0; axis < 2; axis++)
        for (int distance = -1; distance < 2; distance += 2)
            x = machine_binary(m, MACHINE_ADD, x,
                               machine_shift(m, word(s, s->a), axis, distance));
    x = machine_binary(m, MACHINE_MUL, x, word(s, s->b));
    return machine_field_store(m, s->a, x, MACHINE_EVERYWHERE) == MACHINE_OK;
}

static void turn_again(const struct machine_call *call)
{
    const struct sheet *s = (const struct sheet *)(uintptr_t)call->words[0];
    struct machine_call known = {
        .again = turn_again, .name = "turn", .words_count = 1, .words = {call->words[0]}};
    if (machine_call_foreseen(s->m, &known))
        return;
    machine_begin(s->m);
    if (turn(s))
        machine_call_performed(s->m);
    else
        machine_call_failed(s->m);
}

/* Reads the result of the turns by a scan and a sum. */
static bool look(const struct sheet *s, struct result *r)
{
    struct machine *m = s->m;
    struct machine_scalar sum;
    machine_begin(m);
    struct machine_scan how = {.axis = 1, .op = MACHINE_SCAN_ADD};
    struct machine_value *x = machine_scan(m, &how, word(s, s->a));
    if (!x || machine_field_store(m, s->b, x, MACHINE_EVERYWHERE) != MACHINE_OK ||
        machine_reduce(m, MACHINE_REDUCE_ADD, word(s, s->b), &sum) != MACHINE_OK)
        return false;
    r->sum = sum.lo;
    return machine_field_download(m, s->b, MACHINE_UINT(32), r->numbers) == MACHINE_OK;
}

static bool work(struct sheet *s, struct result *r)
{
    struct machine_config config = machine_config_default();
    const int dimensions[2] = {HEIGHT, WIDTH};
    uint32_t start[COUNT];
    config.processors_count = 16;
    config.eager = 0;
    config.trace = trace_path;
    if (machine_create(&config, &s->m) != MACHINE_OK)
        return false;
    int set = machine_vpset_create(s->m, dimensions, 2);
    machine_vpset_select(s->m, set);
    s->a = machine_field_allocate(s->m, set, 32, MACHINE_HEAP);
    s->b = machine_field_allocate(s->m, set, 32, MACHINE_HEAP);
    for (uint32_t i = 0; i < COUNT; i++)
        start[i] = i * 2654435761u;
    if (machine_field_upload(s->m, s->a, MACHINE_UINT(32), start) != MACHINE_OK ||
        machine_field_upload(s->m, s->b, MACHINE_UINT(32), start) != MACHINE_OK)
        return false;
    const struct machine_call call = {.words = {(uintptr_t)s}};
    for (int i = 0; i < TURNS; i++)
        turn_again(&call);
    for (int i = 0; background && s->m->plans->improving && i < 60000; i++) {
        usleep(1000);
        plans_see_to(s->m);
    }
    struct machine_stats stats;
    machine_stats_get(s->m, &stats);
    r->foreseen = background ? stats.kernels_built_background > 0 : stats.calls_foreseen;
    return machine_finish(s->m) == MACHINE_OK && look(s, r);
}

static void *thread(void *data)
{
    struct result *r = data;
    for (int i = 0; i < times && !r->error[0]; i++) {
        struct sheet s = {.m = NULL};
        if (!work(&s, r))
            snprintf(r->error, sizeof r->error, "%s", s.m ? machine_error(s.m) : "no memory");
        machine_destroy(s.m);
    }
    return NULL;
}

static void together(void)
{
    static struct result alone, results[THREADS];
    pthread_t threads[THREADS];
    memset(&alone, 0, sizeof alone);
    memset(results, 0, sizeof results);
    thread(&alone);
    assert_string_equal(alone.error, "");
    assert_true(alone.foreseen > 0);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, thread, &results[i]), 0);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    for (int i = 0; i < THREADS; i++)
        assert_memory_equal(&results[i], &alone, sizeof alone);
}

static void machines_of_several_threads_do_not_meet(void **state)
{
    (void)state;
    together();
}

static void they_write_one_trace(void **state)
{
    char path[] = "/tmp/lutetia-trace-XXXXXX";
    int file = mkstemp(path);
    (void)state;
    assert_true(file >= 0);
    close(file);
    trace_path = path;
    together();
    trace_path = NULL;
    FILE *f = fopen(path, "r");
    char end[3] = "";
    assert_non_null(f);
    assert_int_equal(fseek(f, -3, SEEK_END), 0);
    assert_int_equal(fread(end, 1, 3, f), 3);
    fclose(f);
    unlink(path);
    assert_non_null(memchr(end, ']', 3));
}

/* Each machine has its own background process, which compiles optimised kernels. */
static void each_has_a_background(void **state)
{
    (void)state;
    setenv("LUTETIA_BACKGROUND", "1", 1);
    setenv("LUTETIA_OPTIMISE_AFTER", "1000000", 1);
    setenv("LUTETIA_BOX_AFTER", "1", 1);
    times = 1;
    background = true;
    together();
    unsetenv("LUTETIA_BACKGROUND");
    unsetenv("LUTETIA_BOX_AFTER");
    unsetenv("LUTETIA_OPTIMISE_AFTER");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(machines_of_several_threads_do_not_meet),
        cmocka_unit_test(they_write_one_trace),
        cmocka_unit_test(each_has_a_background),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
