/* test_float_scans.c - sums of floats along a line of more than a hundred runs, in the order
 * that machine_scan() defines: for both directions, inclusions, kinds of segments, contexts and
 * lengths of floats. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"
#include "oracle.h"
#include "scan_set.h"

static number plus(int width, number a, number b)
{
    return oracle_float("add", width, a, b).bits;
}

/* A sum of floats as machine_scan() defines it, of the only line, in one pass: before is what
 * the segment's earlier runs come to, part what this run does. */
static void sums_in_runs(const struct set *s, const struct scan_case *c, number *dest)
{
    enum { RUN = 512 };
    const int length = s->grid.count;
    number before = 0, part = 0;
    bool has_before = false;
    for (int k = 0; k < length; k++) {
        const int at = c->direction ? length - 1 - k : k;
        const bool begins = k == 0 || (c->smode == 1 && s->sbits[at] && s->context_bits[at]) ||
                            (c->smode == 2 && s->sbits[c->direction ? at + 1 : at]);
        if (!begins && k % RUN == 0)
            before = has_before ? plus(c->width, before, part) : part;
        has_before = !begins && (has_before || k % RUN == 0);
        const number old = begins || k % RUN == 0 ? 0 : part;
        part = s->context_bits[at] ? plus(c->width, old, s->numbers[at]) : old;
        const number shown = c->inclusion ? part : old;
        if (s->context_bits[at])
            dest[at] = has_before ? plus(c->width, before, shown) : shown;
    }
}

static void a_very_long_line_of_floats_is_right(void **unused)
{
    (void)unused;
    device_seed(3);
    int length = 70001;
    struct set s = set_new(1, &length);
    for (int turn = 0; turn < 48; turn++) {
        struct scan_case c = {.letter = 'f',
                              .op = "add",
                              .width = turn % 2 ? 64 : 32,
                              .direction = turn / 2 % 2,
                              .inclusion = turn / 4 % 2,
                              .smode = turn / 8 % 3};
        const unsigned int bits = c.width == 32 ? 23 : 52, exponent = c.width == 32 ? 8 : 11;
        set_masks(&s, turn % 3, turn < 24 ? 5 : 2000);
        numbers_random(s.numbers, length, c.width, true);
        numbers_random(s.old, length, c.width, true);
        fields_new(&s, c.width);
        put(&s, s.source, 'f', c.width, s.numbers);
        put(&s, s.dest, 'f', c.width, s.old);
        CM_scan_with_f_add_1L(s.dest, s.source, 0, bits, exponent, (unsigned)c.direction,
                              (unsigned)c.inclusion, (unsigned)c.smode,
                              c.smode ? s.sbit : CM_no_field);
        sums_in_runs(&s, &c, s.old);
        compare(&s, "scan", &c);
    }
    set_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_very_long_line_of_floats_is_right)};
    return cmocka_run_group_tests(tests, device_setup, NULL);
}
