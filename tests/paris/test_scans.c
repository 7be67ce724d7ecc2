/* Compares scans, spreads, reductions, enumerations and ranks with the oracle: over geometries
 * of 1 to 5 axes, directions, inclusions, segments, contexts and lengths.
 *
 * Compiling kernels takes most of the time, and each rank of VP sets needs other kernels. So
 * all operations are tested with three axes (some of length 1), and a few operations with other
 * ranks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"
#include "oracle_scan.h"
#include "scan_calls.h"
#include "scan_set.h"

static unsigned int below(unsigned int n)
{
    return (unsigned int)(device_random() >> 20) % n;
}

enum { SCAN, SPREAD, MULTISPREAD, REDUCE };

static void try_row(struct set *s, const struct row *row, int form, int width)
{
    bool floats = row->letter == 'f', in_place = below(4) == 0;
    struct call call = {.sbit = s->sbit,
                        .axis = below((unsigned)s->grid.rank),
                        .len = (unsigned)width,
                        .s = width == 32 ? 23 : 52,
                        .e = width == 32 ? 8 : 11,
                        .direction = below(2),
                        .inclusion = below(2),
                        .smode = below(3),
                        .mask = below(1u << s->grid.rank)};
    unsigned int length = (unsigned)s->grid.dimensions[call.axis];
    fields_new(s, width);
    call.dest = s->dest;
    call.source = in_place ? s->dest : s->source;
    call.to = below(length);
    call.from = below(length);
    struct scan_case c = {.letter = row->letter,
                          .op = row->op,
                          .width = width,
                          .axis = (int)call.axis,
                          .direction = (int)call.direction,
                          .inclusion = (int)call.inclusion,
                          .smode = (int)call.smode,
                          .context = s->context_bits,
                          .sbit = s->sbits};
    numbers_random(s->numbers, s->grid.count, width, floats);
    numbers_random(s->old, s->grid.count, width, floats);
    if (in_place)
        memcpy(s->numbers, s->old, (size_t)s->grid.count * sizeof *s->old);
    put(s, s->source, row->letter, width, s->numbers);
    put(s, s->dest, row->letter, width, s->old);
    c.source = s->numbers;
    if (call.smode == CM_none)
        call.sbit = CM_no_field;
    switch (form) {
    case SCAN:
        row->scan(&call);
        oracle_scan(&s->grid, &c, s->old);
        compare(s, "scan_with", &c);
        break;
    case SPREAD:
        row->spread(&call);
        oracle_spread(&s->grid, &c, 1u << call.axis, -1, (int)call.from, s->old);
        compare(s, "spread_with", &c);
        break;
    case MULTISPREAD:
        if (!row->multispread)
            break;
        row->multispread(&call);
        oracle_spread(&s->grid, &c, call.mask, -1, 0, s->old);
        compare(s, "multispread_with", &c);
        break;
    default:
        row->reduce(&call);
        oracle_spread(&s->grid, &c, 1u << call.axis, (int)call.to, (int)call.from, s->old);
        compare(s, "reduce_with", &c);
    }
}

/* Two widths for each row; together they have all types of elements. */
static const int widths[ROWS_COUNT][2] = {{33, 7},  {32, 128}, {64, 16},  {65, 32}, {8, 50},
                                          {31, 90}, {1, 48},   {24, 128}, {64, 3},  {32, 64},
                                          {64, 32}, {32, 64},  {64, 32},  {1, 64}};

static void every_operation_is_the_oracles(void **unused)
{
    (void)unused;
    static const int shapes[][3] = {{3, 5, 21}, {2, 3, 70}, {7, 1, 17}, {1, 9, 40}};
    for (int k = 0; k < 4; k++) {
        struct set s = set_new(3, shapes[k]);
        for (int turn = 0; turn < 4; turn++) {
            set_masks(&s, k % 2 == 0 && turn == 3 ? 1 : 2 * (turn / 2), 3 + (int)below(9));
            for (int r = 0; r < ROWS_COUNT; r++) {
                int form = (r + turn) % 4;
                try_row(&s, &rows[r], SCAN, widths[r][turn % 2]);
                try_row(&s, &rows[r], SCAN, widths[r][turn % 2]);
                try_row(&s, &rows[r], form == REDUCE ? SPREAD : form, widths[r][turn % 2]);
            }
        }
        for (int r = 0; r < ROWS_COUNT; r++) /* all in the same elements */
            if (rows[r].letter != 'f')
                try_row(&s, &rows[r], REDUCE, 17 + r);
        try_row(&s, &rows[9], REDUCE, 64);
        set_free(&s);
    }
}

/* The shapes include rows so narrow that they have no repeated columns. */
static void any_rank_of_geometry_is_the_oracles(void **unused)
{
    (void)unused;
    static const struct {
        int rank, dimensions[SCAN_AXES_MAX];
    } shapes[] = {
        {1, {301}}, {2, {19, 33}}, {4, {3, 4, 2, 18}}, {5, {2, 3, 1, 5, 20}}, {3, {5, 30, 3}}};
    static const int some[] = {3, 13}; /* s_add, copy */
    for (int k = 0; k < 5; k++) {
        struct set s = set_new(shapes[k].rank, shapes[k].dimensions);
        for (int turn = 0; turn < 6; turn++) {
            set_masks(&s, turn % 2 ? 2 : 0, 5);
            for (int i = 0; i < 2; i++)
                try_row(&s, &rows[some[i]], turn % 3 == 2 ? SPREAD : SCAN, 32);
        }
        set_free(&s);
    }
}

/* Lines of more than one run: along rows and across rows, one and sixteen columns at a time. */
static void long_lines_are_the_oracles(void **unused)
{
    (void)unused;
    static const int shapes[][3] = {{1, 2, 1300}, {1, 1030, 19}};
    for (int k = 0; k < 2; k++) {
        struct set s = set_new(3, shapes[k]);
        for (int turn = 0; turn < 2; turn++) {
            set_masks(&s, turn ? 2 : 1, turn ? 400 : 9);
            for (int r = 0; r < ROWS_COUNT; r++)
                if (rows[r].letter == 'f')
                    try_row(&s, &rows[r], turn ? SCAN : 1 + r % 3, r % 2 ? 32 : 64);
                else if (rows[r].letter == 'b' && strcmp(rows[r].op, "logand") == 0)
                    try_row(&s, &rows[r], SCAN, 32);
        }
        set_free(&s);
    }
}

/* Floats in so many runs that some are scanned beside one another, and some are left. */
static void lines_of_many_runs_are_the_oracles(void **unused)
{
    (void)unused;
    static const int lengths[] = {4097, 5800};
    for (int k = 0; k < 2; k++) {
        struct set s = set_new(1, &lengths[k]);
        for (int turn = 0; turn < 3; turn++) {
            set_masks(&s, turn, turn == 1 ? 3000 : 7);
            for (int r = 0; r < ROWS_COUNT; r++)
                if (strcmp(rows[r].op, "add") == 0 || strcmp(rows[r].op, "multiply") == 0)
                    for (int width = 32; rows[r].letter == 'f' && width <= 64; width += 32)
                        try_row(&s, &rows[r], SCAN, width);
        }
        set_free(&s);
    }
}

/* Integers in one line, so long that sums are carried from run to run and ranks have many
 * chunks of keys. */
static void a_very_long_line_is_right(void **unused)
{
    (void)unused;
    int length = 70001;
    struct set s = set_new(1, &length);
    uint64_t sum = 0, seed = 0;
    for (int turn = 0; turn < 3; turn++) {
        int width = turn == 2 ? 64 : 32;
        uint64_t mask = (uint64_t)oracle_mask(width);
        set_masks(&s, turn == 1 ? 2 : 1, 9000);
        for (int i = 0; i < length; i++)
            s.numbers[i] = device_random() & mask;
        fields_new(&s, width);
        put(&s, s.source, 'u', width, s.numbers);
        CM_scan_with_u_add_1L(s.dest, s.source, 0, (unsigned)width, CM_upward, CM_inclusive,
                              turn ? CM_segment_bit : CM_none, turn ? s.sbit : CM_no_field);
        get(&s, s.dest, 'u', width, s.got);
        sum = 0;
        for (int i = 0; i < length; i++) {
            if (turn && s.sbits[i])
                sum = 0;
            if (!s.context_bits[i])
                continue;
            sum += (uint64_t)s.numbers[i];
            if ((sum & mask) != (uint64_t)s.got[i])
                fail_msg("turn %d, processor %d: got %llx, wanted %llx", turn, i,
                         (unsigned long long)s.got[i], (unsigned long long)(sum & mask));
        }
        CM_scan_with_copy_1L(s.dest, s.source, 0, (unsigned)width, CM_downward, CM_inclusive,
                             CM_segment_bit, s.sbit);
        get(&s, s.dest, 'u', width, s.got);
        bool has = false;
        for (int i = length - 1; i >= 0; i--) {
            if (s.context_bits[i] && !has) {
                seed = (uint64_t)s.numbers[i];
                has = true;
            }
            if (s.context_bits[i] && seed != (uint64_t)s.got[i])
                fail_msg("turn %d, processor %d: copied %llx, wanted %llx", turn, i,
                         (unsigned long long)s.got[i], (unsigned long long)seed);
            if (s.sbits[i])
                has = false;
        }
    }
    set_free(&s);
}

/* ---- ranks ---- */

static void rank_call(const struct set *s, const struct scan_case *c, unsigned int dlen)
{
    unsigned int width = (unsigned)c->width, axis = (unsigned)c->axis,
                 direction = (unsigned)c->direction, smode = (unsigned)c->smode;
    CM_field_id_t sbit = c->smode ? s->sbit : CM_no_field;
    if (c->letter == 'u')
        CM_u_rank_2L(s->dest, s->source, axis, dlen, width, direction, smode, sbit);
    else if (c->letter == 's')
        CM_s_rank_2L(s->dest, s->source, axis, dlen, width, direction, smode, sbit);
    else
        CM_f_rank_2L(s->dest, s->source, axis, dlen, width == 32 ? 23 : 52,
                     width == 32 ? 8 : 11, direction, smode, sbit);
}

static void try_rank(struct set *s, struct scan_case c)
{
    c.op = "rank";
    c.axis = (int)below((unsigned)s->grid.rank);
    c.source = s->numbers;
    c.context = s->context_bits;
    c.sbit = s->sbits;
    numbers_random(s->numbers, s->grid.count, c.width, c.letter == 'f');
    for (int i = 0; i < s->grid.count; i++)
        if (device_random() % 4 == 0) /* equal ones */
            s->numbers[i] = s->numbers[below((unsigned)s->grid.count)];
    fields_new(s, c.width);
    s->dest = CM_allocate_stack_field(20);
    put(s, s->source, c.letter, c.width, s->numbers);
    numbers_random(s->old, s->grid.count, 20, false);
    put(s, s->dest, 'u', 20, s->old);
    rank_call(s, &c, 20);
    oracle_rank(&s->grid, &c, s->old);
    c.letter = 'u';
    c.width = 20;
    compare(s, "rank", &c);
}

static void ranks_are_the_oracles(void **unused)
{
    (void)unused;
    static const int shapes[][3] = {{3, 5, 21}, {9, 1, 70}, {1, 80, 17}};
    static const struct scan_case cases[] = {
        {.letter = 'u', .width = 32, .direction = CM_upward, .smode = CM_none},
        {.letter = 'u', .width = 9, .direction = CM_downward, .smode = CM_segment_bit},
        {.letter = 'u', .width = 1, .direction = CM_downward, .smode = CM_none},
        {.letter = 's', .width = 50, .direction = CM_upward, .smode = CM_start_bit},
        {.letter = 's', .width = 128, .direction = CM_downward, .smode = CM_none},
        {.letter = 'f', .width = 32, .direction = CM_upward, .smode = CM_segment_bit},
        {.letter = 'f', .width = 64, .direction = CM_downward, .smode = CM_none},
    };
    for (int k = 0; k < 3; k++) {
        struct set s = set_new(3, shapes[k]);
        for (int turn = 0; turn < 3; turn++) {
            set_masks(&s, turn, 4 + (int)below(20));
            for (int i = 0; i < (turn == 1 ? 3 : 7); i++)
                try_rank(&s, cases[i]);
        }
        set_free(&s);
    }
}

static const number *sorted_by;
static int by_number(const void *a, const void *b)
{
    int i = *(const int *)a, j = *(const int *)b;
    if (sorted_by[i] != sorted_by[j])
        return sorted_by[i] < sorted_by[j] ? -1 : 1;
    return i - j;
}

static void ranks_of_a_very_long_line_are_right(void **unused)
{
    (void)unused;
    int length = 100003, *order = malloc((size_t)length * sizeof *order);
    struct set s = set_new(1, &length);
    assert_non_null(order);
    for (int turn = 0; turn < 3; turn++) {
        int width = turn == 1 ? 9 : 32, active = 0;
        set_masks(&s, turn == 2 ? 2 : 1, 1000);
        for (int i = 0; i < length; i++)
            s.numbers[i] = device_random() & (uint64_t)oracle_mask(width);
        fields_new(&s, width);
        s.dest = CM_allocate_stack_field(32);
        put(&s, s.source, 'u', width, s.numbers);
        CM_u_rank_2L(s.dest, s.source, 0, 32, (unsigned)width, CM_upward, CM_none, CM_no_field);
        get(&s, s.dest, 'u', 32, s.got);
        for (int i = 0; i < length; i++)
            if (s.context_bits[i])
                order[active++] = i;
        sorted_by = s.numbers;
        qsort(order, (size_t)active, sizeof *order, by_number);
        for (int i = 0; i < active; i++)
            if (s.got[order[i]] != (number)i)
                fail_msg("turn %d: processor %d has rank %d, wanted %d", turn, order[i],
                         (int)s.got[order[i]], i);
    }
    free(order);
    set_free(&s);
}

/* ---- the others ---- */

static void enumeration_counts_the_active(void **unused)
{
    (void)unused;
    static const int shape[3] = {3, 5, 21};
    struct set s = set_new(3, shape);
    for (int turn = 0; turn < 6; turn++) {
        set_masks(&s, turn % 3, 6);
        struct scan_case c = {.letter = 'u',
                              .op = "add",
                              .width = 17,
                              .axis = turn % 3,
                              .direction = (int)below(2),
                              .inclusion = (int)below(2),
                              .smode = (int)below(3),
                              .source = s.numbers,
                              .context = s.context_bits,
                              .sbit = s.sbits};
        for (int i = 0; i < s.grid.count; i++)
            s.numbers[i] = 1;
        numbers_random(s.old, s.grid.count, 17, false);
        fields_new(&s, 17);
        put(&s, s.dest, 'u', 17, s.old);
        (turn % 2 ? CM_enumerate_1L
                  : CM_enumerate)(s.dest, (unsigned)c.axis, 17, (unsigned)c.direction,
                                  (unsigned)c.inclusion, (unsigned)c.smode, s.sbit);
        oracle_scan(&s.grid, &c, s.old);
        compare(&s, "enumerate", &c);
    }
    set_free(&s);
}

/* Tests long bit fields, complex numbers, one processor's field and the longest integer. The
 * third part is no whole word. */
static void long_fields_go_in_parts(void **unused)
{
    (void)unused;
    static const int shape[3] = {3, 5, 21}, parts[] = {64, 64, 17};
    struct set s = set_new(3, shape);
    set_masks(&s, 2, 5);
    struct scan_case c = {.letter = 'b',
                          .op = "copy",
                          .axis = 2,
                          .inclusion = CM_inclusive,
                          .smode = CM_segment_bit,
                          .context = s.context_bits,
                          .sbit = s.sbits};
    number *halves[3], *olds[3];
    fields_new(&s, 145);
    for (int i = 0, offset = 0; i < 3; offset += parts[i++]) {
        halves[i] = numbers_new(s.grid.count);
        olds[i] = numbers_new(s.grid.count);
        numbers_random(halves[i], s.grid.count, parts[i], false);
        numbers_random(olds[i], s.grid.count, parts[i], false);
        put(&s, s.source + (unsigned)offset, 'b', parts[i], halves[i]);
        put(&s, s.dest + (unsigned)offset, 'b', parts[i], olds[i]);
    }
    CM_scan_with_copy_1L(s.dest, s.source, 2, 145, CM_upward, CM_inclusive, CM_segment_bit,
                         s.sbit);
    for (int round = 0; round < 2; round++) {
        for (int i = 0, offset = 0; i < 3; offset += parts[i++]) {
            struct set piece = s;
            c.width = parts[i];
            c.source = halves[i];
            if (round == 0)
                oracle_scan(&s.grid, &c, olds[i]);
            for (int n = 0; round == 1 && n < s.grid.count; n++)
                if (s.context_bits[n])
                    olds[i][n] = halves[i][37];
            piece.dest += (unsigned)offset;
            piece.old = olds[i];
            compare(&piece, "long", &c);
        }
        if (round == 0)
            CM_spread_from_processor_1L(
                s.dest, (unsigned)machine_send_address(paris_machine(), s.id, 37), s.source,
                145);
    }
    for (int i = 0; i < 3; i++) {
        free(halves[i]);
        free(olds[i]);
    }
    set_free(&s);
}

static void sums_of_complex_numbers_are_of_their_parts(void **unused)
{
    (void)unused;
    static const int shape[3] = {3, 5, 21};
    struct set s = set_new(3, shape);
    set_masks(&s, 2, 5);
    struct scan_case c = {.letter = 'f',
                          .op = "add",
                          .width = 64,
                          .axis = 1,
                          .inclusion = CM_exclusive,
                          .context = s.context_bits,
                          .sbit = s.sbits};
    number *halves[2], *olds[2];
    fields_new(&s, 128);
    for (int i = 0; i < 2; i++) {
        halves[i] = numbers_new(s.grid.count);
        olds[i] = numbers_new(s.grid.count);
        numbers_random(halves[i], s.grid.count, 64, true);
        numbers_random(olds[i], s.grid.count, 64, true);
        put(&s, s.source + 64u * (unsigned)i, 'f', 64, halves[i]);
        put(&s, s.dest + 64u * (unsigned)i, 'f', 64, olds[i]);
    }
    CM_scan_with_c_add_1L(s.dest, s.source, 1, 52, 11, CM_upward, CM_exclusive, CM_none,
                          CM_no_field);
    for (int i = 0; i < 2; i++) {
        struct set piece = s;
        c.source = halves[i];
        oracle_scan(&s.grid, &c, olds[i]);
        piece.dest += 64u * (unsigned)i;
        piece.old = olds[i];
        compare(&piece, "complex", &c);
        free(halves[i]);
        free(olds[i]);
    }
    set_free(&s);
}

static void the_longest_number_is_found(void **unused)
{
    (void)unused;
    static const int shape[3] = {3, 5, 21};
    struct set s = set_new(3, shape);
    set_masks(&s, 2, 5);
    unsigned int longest = 0, longest_signed = 0;
    fields_new(&s, 70);
    numbers_random(s.numbers, s.grid.count, 70, false);
    put(&s, s.source, 'u', 70, s.numbers);
    for (int n = 0; n < s.grid.count; n++) {
        number x = s.numbers[n], y = x >> 69 ? ~x & oracle_mask(70) : x;
        for (unsigned int b = 0; s.context_bits[n] && b < 70; b++) {
            longest = x >> b && longest < b + 1 ? b + 1 : longest;
            longest_signed = y >> b && longest_signed < b + 1 ? b + 1 : longest_signed;
        }
    }
    assert_int_equal(CM_global_u_max_u_intlen_1L(s.source, 70), longest);
    assert_int_equal(CM_global_u_max_s_intlen_1L(s.source, 70), longest_signed);
    CM_set_context();
    CM_u_move_zero_1L(s.source, 70);
    assert_int_equal(CM_global_u_max_u_intlen(s.source, 70), 0);
    assert_int_equal(CM_global_u_max_s_intlen(s.source, 70), 0);
    set_free(&s);
}

static void what_is_wrong_is_said(void **unused)
{
    (void)unused;
    static const int shape[3] = {3, 5, 21};
    struct set s = set_new(3, shape);
    fields_new(&s, 160);
    CM_set_error_handler(device_error_catch);
    for (unsigned int mode = 0; mode < 2; mode++) {
        mode ? CM_set_safety_mode(1) : paris_safety_usual();
        CM_scan_with_u_add_1L(s.dest, s.source, 3, 32, 0, 1, 0, CM_no_field);
        device_said("CM_scan_with_u_add_1L", "axis: must be 0..2");
        CM_scan_with_u_add_1L(s.dest, s.source, 1, 32, 2, 1, 0, CM_no_field);
        device_said("CM_scan_with_u_add_1L", "direction: must be");
        CM_scan_with_copy_1L(s.dest, s.source, 1, 32, 0, 2, 0, CM_no_field);
        device_said("CM_scan_with_copy_1L", "inclusion: must be");
        CM_u_rank_2L(s.dest, s.source, 1, 32, 32, 0, 3, s.sbit);
        device_said("CM_u_rank_2L", "smode: must be");
        CM_enumerate_1L(s.dest, 1, 32, 0, 0, 1, CM_no_field);
        device_said("CM_enumerate_1L", "");
        CM_scan_with_u_add_1L(s.dest, s.source, 1, 129, 0, 1, 0, CM_no_field);
        device_said("CM_scan_with_u_add_1L", "length must be");
        CM_u_rank_2L(s.dest, s.source, 1, 0, 32, 0, 0, CM_no_field);
        device_said("CM_u_rank_2L", "length must be");
        CM_spread_with_copy_1L(s.dest, s.source, 1, 8, 5);
        device_said("CM_spread_with_copy_1L", "coordinate: must be 0..4 on axis 1");
        CM_reduce_with_u_add_1L(s.dest, s.source, 2, 8, 21);
        device_said("CM_reduce_with_u_add_1L", "to_coordinate: must be 0..20");
        CM_multispread_with_u_add_1L(s.dest, s.source, 8, 8);
        device_said("CM_multispread_with_u_add_1L", "axis_mask: there are only 3 axes");
        CM_multispread_copy_1L(s.dest, s.source, 9, 8, 0);
        device_said("CM_multispread_copy_1L", "axis_mask: there are only 3 axes");
        CM_multispread_copy_1L(s.dest, s.source, 5, 8, 63);
        device_said("CM_multispread_copy_1L", "multi_coordinate: there is no position 63");
        CM_spread_from_processor_1L(s.dest, 100000, s.source, 8);
        device_said("CM_spread_from_processor_1L", "send_address: there is no processor");
        CM_scan_with_logior_1L(s.dest, s.source, 1, 161, 0, 1, 0, CM_no_field);
        device_said("CM_scan_with_logior_1L", "");
        CM_scan_with_logior_1L(s.dest, s.source, 1, 0, 0, 1, 0, CM_no_field); /* nothing */
        assert_true(device_message[0] == 0);
    }
    paris_safety_usual();
    CM_set_error_handler(NULL);
    set_free(&s);
}

static void multispread_copy_takes_one_position(void **unused)
{
    (void)unused;
    static const int shape[3] = {3, 5, 21};
    struct set s = set_new(3, shape);
    enum { WIDTH = 40 };
    fields_new(&s, WIDTH);
    for (unsigned int mask = 0; mask < 8; mask++) {
        int at[3] = {0}, left, positions = 1;
        for (int axis = 0; axis < 3; axis++)
            positions *= mask >> axis & 1 ? shape[axis] : 1;
        left = (int)below((unsigned)positions);
        unsigned int position = (unsigned)left;
        for (int axis = 2; axis >= 0; axis--)
            if (mask >> axis & 1) {
                at[axis] = left % shape[axis];
                left /= shape[axis];
            }
        numbers_random(s.numbers, s.grid.count, WIDTH, false);
        numbers_random(s.old, s.grid.count, WIDTH, false);
        put(&s, s.source, 'b', WIDTH, s.numbers);
        put(&s, s.dest, 'b', WIDTH, s.old);
        set_masks(&s, 2, 5);
        (mask % 2 ? CM_multispread_copy_1L
                  : CM_multispread_with_copy_1L)(s.dest, s.source, mask, WIDTH, position);
        get(&s, s.dest, 'b', WIDTH, s.got);
        for (int i = 0; i < s.grid.count; i++) {
            int c[3] = {i / (5 * 21), i / 21 % 5, i % 21};
            for (int axis = 0; axis < 3; axis++)
                c[axis] = mask >> axis & 1 ? at[axis] : c[axis];
            number wanted =
                s.context_bits[i] ? s.numbers[(c[0] * 5 + c[1]) * 21 + c[2]] : s.old[i];
            if (s.got[i] != wanted)
                fail_msg("mask %u, position %u, processor %d: got %llx, wanted %llx", mask,
                         position, i, (unsigned long long)s.got[i], (unsigned long long)wanted);
        }
    }
    set_free(&s);
}

static int start(void **unused)
{
    (void)unused;
    device_start(-1);
    device_seed(3);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_operation_is_the_oracles),
        cmocka_unit_test(any_rank_of_geometry_is_the_oracles),
        cmocka_unit_test(long_lines_are_the_oracles),
        cmocka_unit_test(lines_of_many_runs_are_the_oracles),
        cmocka_unit_test(a_very_long_line_is_right),
        cmocka_unit_test(ranks_are_the_oracles),
        cmocka_unit_test(ranks_of_a_very_long_line_are_right),
        cmocka_unit_test(enumeration_counts_the_active),
        cmocka_unit_test(multispread_copy_takes_one_position),
        cmocka_unit_test(long_fields_go_in_parts),
        cmocka_unit_test(sums_of_complex_numbers_are_of_their_parts),
        cmocka_unit_test(the_longest_number_is_found),
        cmocka_unit_test(what_is_wrong_is_said),
    };
    return cmocka_run_group_tests(tests, start, NULL);
}
