/* generate.c - draws a program from a seed.
 *
 * Most programs that are drawn blindly could not run. So the generator keeps a list of fields
 * and their VP sets and draws operands from it; program_normalise() drops what still cannot
 * run. Most of a run's time goes into compiling a kernel for each new shape of graph, so
 * geometries and widths come from small pools.
 */
#include "program.h"

#include <string.h>

#include "sample.h"

static const struct geometry geometries[] = {
    {1, {7}},           {2, {5, 3}}, {2, {3, 43}}, {3, {2, 3, 5}}, {1, {1}},
    {4, {3, 1, 2, 41}}, {2, {1, 2}}, {1, {97}},    {2, {9, 40}},   {3, {4, 2, 17}},
};

/* Geometries wide enough for strips of vectors; some widths are powers of two. */
static const struct geometry sheets[] = {
    {2, {9, 96}}, {2, {37, 64}}, {2, {5, 133}}, {2, {16, 128}}};

/* Lengths of fields: room for floats, and odd lengths. */
static const uint8_t sizes[] = {32, 32, 64, 33, 1, 8, 24, 96, 128, 5, 160, 17, 65, 70};
static const uint8_t widths[] = {1, 2, 5, 8, 16, 24, 31, 32, 33, 48, 63, 64, 65, 96, 127, 128};

struct generator {
    struct program *p;
    uint64_t state;
    struct {
        int bits, set;
    } slots[PROGRAM_SLOTS];
    int set;
    bool sheet; /* the program has only fields of 32 bits and of 1 bit, in one of sheets[] */
    bool pure;  /* no instruction that reads, writes or draws random numbers */
};

static uint32_t draw(struct generator *g, uint32_t below)
{
    return (uint32_t)(sample_word(&g->state) >> 32) % below;
}

/* Draws a part, `bits` long, of a field of the current VP set; it mostly starts at the field's
 * first bit. */
static bool draw_operand(struct generator *g, int bits, struct operand *out)
{
    for (int tries = 0; tries < 40; tries++) {
        uint32_t slot = draw(g, PROGRAM_SLOTS);
        int room = g->slots[slot].bits - bits;

        if (g->slots[slot].bits == 0 || g->slots[slot].set != g->set || room < 0)
            continue;
        out->slot = (uint8_t)slot;
        out->bits = (uint8_t)bits;
        out->offset = (uint8_t)(room && draw(g, 4) == 0 ? draw(g, (uint32_t)room + 1) : 0);
        return true;
    }
    return false;
}

static void emit(struct generator *g, const struct instruction *in)
{
    if (g->p->count < PROGRAM_LENGTH_MAX)
        g->p->code[g->p->count++] = *in;
}

static void emit_allocate(struct generator *g)
{
    struct instruction in = {0};
    uint32_t slot = draw(g, PROGRAM_SLOTS);

    if (g->slots[slot].bits)
        return;
    in.row = (uint16_t)(draw(g, 3) ? ROW_CM_allocate_heap_field : ROW_CM_allocate_stack_field);
    in.d.slot = (uint8_t)slot;
    in.d.bits = g->sheet ? (draw(g, 4) ? 32 : 1) : sizes[draw(g, sizeof sizes)];
    g->slots[slot].bits = in.d.bits;
    g->slots[slot].set = g->set;
    emit(g, &in);
}

static void emit_deallocate(struct generator *g)
{
    struct instruction in = {0};
    uint32_t slot = draw(g, PROGRAM_SLOTS);

    /* normalising keeps the deallocation that fits the field's region; the stack fields
     * allocated after it go, too */
    in.d.slot = (uint8_t)slot;
    in.row = ROW_CM_deallocate_heap_field;
    emit(g, &in);
    if (draw(g, 4) == 0) {
        in.row = ROW_CM_deallocate_stack_through;
        emit(g, &in);
    }
    g->slots[slot].bits = 0;
}

static void emit_fill(struct generator *g)
{
    struct instruction in = {0};
    bool floats = draw(g, 2);
    int bits = g->sheet ? 32 : floats ? (draw(g, 3) ? 32 : 64) : widths[draw(g, 8)];

    in.row = floats ? ROW_CM_f_write_to_news_array_1L : ROW_CM_u_write_to_news_array_1L;
    in.where = draw(g, 1u << 30);
    if (draw_operand(g, bits, &in.d))
        emit(g, &in);
}

static double draw_real(struct generator *g)
{
    static const double usual[] = {0.0,   1.0, 0.75, 0.5,  -2.0, 3.5,
                                   255.0, 0.1, -0.0, 1e30, 1e-40};

    return usual[draw(g, sizeof usual / sizeof usual[0])];
}

static void emit_row(struct generator *g)
{
    struct instruction in = {0};
    const struct row_info *info;
    int bits = widths[draw(g, sizeof widths)], float_bits = draw(g, 3) ? 32 : 64;

    in.row = (uint16_t)(ROW_CM_u_write_to_processor_1L +
                        draw(g, ROW_COUNT - ROW_CM_u_write_to_processor_1L));
    info = &row_table[in.row];
    if (g->pure && (info->shape == INT_GLOBAL || info->shape == FLOAT_GLOBAL ||
                    info->shape == READ_PROCESSOR || info->shape == WRITE_PROCESSOR ||
                    info->shape == WRITE_PROCESSOR_FLOAT || info->shape == RANDOM))
        return;
    if (info->shape == FLAG && draw(g, 2))
        return;
    /* each read needs kernels of its own */
    if ((info->shape == INT_GLOBAL || info->shape == FLOAT_GLOBAL ||
         info->shape == READ_PROCESSOR) &&
        draw(g, 4))
        return;
    if (info->number == NUMBER_F)
        bits = float_bits;
    else if (info->shape == BIT_LOAD || info->shape == BIT_STORE)
        bits = 1;
    else if (info->shape == RANDOM || info->shape == INT_GLOBAL ||
             info->shape == WRITE_PROCESSOR || info->shape == READ_PROCESSOR)
        bits = widths[draw(g, 8)];
    if (!draw_operand(g, bits, &in.d) || !draw_operand(g, bits, &in.a) ||
        !draw_operand(g, bits, &in.b))
        return;
    switch ((int)info->shape) {
    case INT_3_3L:
    case INT_MOVE_2L:
    case INT_COMPARE_2L:
        if (!draw_operand(g, widths[draw(g, sizeof widths)], &in.a) ||
            !draw_operand(g, widths[draw(g, sizeof widths)], &in.b))
            return;
        break;
    case INT_TO_FLOAT:
        if (!draw_operand(g, float_bits, &in.d))
            return;
        break;
    case FLOAT_TO_INT:
        if (!draw_operand(g, float_bits, &in.a))
            return;
        break;
    case FLOAT_MOVE_2L:
        if (!draw_operand(g, draw(g, 2) ? 32 : 64, &in.a))
            return;
        break;
    default:
        break;
    }
    in.constant = (int64_t)draw(g, draw(g, 2) ? 16 : 1u << 30);
    in.real = draw_real(g);
    in.axis = (uint8_t)draw(g, PROGRAM_AXES);
    in.direction = (uint8_t)draw(g, 2);
    in.where = draw(g, 1u << 30);
    emit(g, &in);
}

/* Nested context, as programs have it: stores the context, narrows it, runs instructions and
 * loads it again. */
static void emit_nest(struct generator *g, int depth)
{
    struct instruction in = {0}, compare = {0};
    struct operand saved;

    if (!draw_operand(g, 1, &saved) || !draw_operand(g, 32, &compare.a))
        return;
    in.row = ROW_CM_store_context;
    in.d = saved;
    emit(g, &in);
    compare.row = (uint16_t)(draw(g, 2) ? ROW_CM_f_gt_zero_1L : ROW_CM_s_gt_zero_1L);
    emit(g, &compare);
    in.row = ROW_CM_logand_context_with_test;
    emit(g, &in);
    for (uint32_t n = 2 + draw(g, 5); n > 0; n--)
        emit_row(g);
    if (depth < 2 && draw(g, 3) == 0)
        emit_nest(g, depth + 1);
    in.row = ROW_CM_load_context;
    in.a = saved;
    emit(g, &in);
}

static void emit_news(struct generator *g)
{
    struct instruction in = {0};
    int bits = g->sheet || draw(g, 2) ? 32 : widths[draw(g, sizeof widths)];

    in.row = (uint16_t)(draw(g, 3) ? ROW_CM_get_from_news_1L : ROW_CM_send_to_news_1L);
    in.axis = (uint8_t)draw(g, PROGRAM_AXES);
    in.direction = (uint8_t)draw(g, 2);
    if (draw_operand(g, bits, &in.d) && draw_operand(g, bits, &in.a))
        emit(g, &in);
}

static void emit_observe(struct generator *g)
{
    struct instruction in = {0};

    in.row = ROW_CM_u_read_from_news_array_1L;
    if (draw_operand(g, draw(g, 2) ? 32 : widths[draw(g, 8)], &in.a))
        emit(g, &in);
}

/* A loop: the same instructions in each turn, seldom with another constant; some turns read a
 * field to the front end. */
static void emit_loop(struct generator *g, int turns)
{
    int first = g->p->count;
    uint32_t look_every = g->sheet ? 90 : draw(g, 3) ? 1 + draw(g, 5) : 1000;
    struct instruction look = {.row = ROW_CM_u_read_from_news_array_1L};
    bool can_look = draw_operand(g, 32, &look.a);

    g->pure = g->sheet || draw(g, 8);
    for (uint32_t n = 2 + draw(g, 6); n > 0; n--)
        if (draw(g, 6) == 0)
            emit_nest(g, 1);
        else if (draw(g, g->sheet ? 2 : 3) == 0)
            emit_news(g);
        else
            emit_row(g);
    g->pure = false;
    int count = g->p->count - first;
    for (int turn = 1; turn < turns; turn++) {
        int odd = draw(g, g->sheet ? 400 : 40) == 0 ? (int)draw(g, (uint32_t)count + 1) : -1;
        if (can_look && draw(g, 40) && (uint32_t)turn % look_every == 0)
            emit(g, &look);
        for (int k = 0; k < count; k++) {
            struct instruction in = g->p->code[first + k];
            if (k == odd)
                in.constant ^= 1, in.real += 1;
            emit(g, &in);
        }
    }
}

static void emit_select(struct generator *g)
{
    struct instruction in = {0};

    in.row = ROW_CM_set_vp_set;
    in.set = (uint8_t)draw(g, (uint32_t)g->p->sets_count);
    g->set = in.set;
    emit(g, &in);
}

/* Draws VP sets and allocates fields with contents. */
static struct generator begin(struct program *p, uint64_t seed, bool sheet)
{
    struct generator g = {.p = p, .state = seed * 0x2545f4914f6cdd1du + 12345, .sheet = sheet};
    struct instruction in = {0};

    memset(p, 0, sizeof *p);
    p->seed = seed;
    p->sets_count = sheet || draw(&g, 3) ? 1 : 1 + (int)draw(&g, PROGRAM_SETS);
    if (sheet)
        p->sets[0] = sheets[draw(&g, sizeof sheets / sizeof *sheets)];
    for (int k = 0; k < p->sets_count && !sheet; k++)
        p->sets[k] = geometries[draw(&g, sizeof geometries / sizeof geometries[0])];

    for (int set = 0; set < p->sets_count; set++) {
        in.row = ROW_CM_set_vp_set;
        in.set = (uint8_t)set;
        g.set = set;
        if (p->sets_count > 1)
            emit(&g, &in);
        for (int k = 0; k < (sheet ? 6 : 4); k++)
            emit_allocate(&g);
        emit_fill(&g);
        emit_fill(&g);
    }
    return g;
}

void program_generate_loop(struct program *p, uint64_t seed, bool sheet)
{
    struct generator g = begin(p, seed, sheet);

    for (int n = 0; n < (sheet ? 2 : 6); n++)
        emit_row(&g);
    emit_loop(&g, sheet ? 160 + (int)draw(&g, 80) : 30 + (int)draw(&g, 40));
    emit_row(&g);
    emit_observe(&g);
}

void program_generate(struct program *p, uint64_t seed, int length)
{
    struct generator g = begin(p, seed, false);

    if (length > PROGRAM_LENGTH_MAX)
        length = PROGRAM_LENGTH_MAX;
    while (p->count < length) {
        uint32_t what = draw(&g, 100);

        if (what < 62)
            emit_row(&g);
        else if (what < 72)
            emit_news(&g);
        else if (what < 80)
            emit_fill(&g);
        else if (what < 87)
            emit_nest(&g, 0);
        else if (what < 92)
            emit_allocate(&g);
        else if (what < 94)
            emit_deallocate(&g);
        else if (what < 96 && p->sets_count > 1)
            emit_select(&g);
        else if (what == 96 || what == 97)
            emit_loop(&g, 3 + (int)draw(&g, 6));
        else if (what == 99 && draw(&g, 2))
            emit_observe(&g);
    }
}
