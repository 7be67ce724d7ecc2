/* print.c - prints a program as C with CM_ calls, for a person to read and to run.
 *
 * Fields are f0, f1, …. The C program prints what it observes, so that two modes of the machine
 * can be compared by hand. */
#include <inttypes.h>
#include <math.h>

#include "program.h"

static void print_part(FILE *out, const struct operand *x)
{
    if (x->offset)
        fprintf(out, "CM_add_offset_to_field_id (f%d, %d)", x->slot, x->offset);
    else
        fprintf(out, "f%d", x->slot);
}

static void print_length(FILE *out, const struct operand *x, bool is_float)
{
    if (is_float)
        fprintf(out, ", %s", x->bits == 32 ? "23, 8" : "52, 11");
    else
        fprintf(out, ", %d", x->bits);
}

/* The arguments of each shape, a letter each: d a b fields, k an integer constant, r a real
 * one, D A B integer lengths, F G float lengths (of d, of a), x axis and direction, c axis. */
static const char *arguments(enum shape shape)
{
    switch (shape) {
    case INT_1:
        return "dD";
    case INT_MOVE:
    case INT_2:
        return "daD";
    case INT_3:
        return "dabD";
    case INT_3_3L:
        return "dabDAB";
    case RANDOM:
        return "dDk";
    case INT_CONSTANT_2:
    case INT_MOVE_CONSTANT:
        return "dkD";
    case INT_CONSTANT_3:
        return "dakD";
    case INT_MOVE_2L:
        return "daDA";
    case INT_COMPARE:
        return "abA";
    case INT_COMPARE_2L:
        return "abAB";
    case INT_COMPARE_CONSTANT:
        return "akA";
    case INT_COMPARE_ZERO:
    case INT_GLOBAL:
        return "aA";
    case INT_TO_FLOAT:
        return "daAF";
    case FLOAT_TO_INT:
        return "daDG";
    case FLOAT_1:
        return "dF";
    case FLOAT_MOVE:
    case FLOAT_2:
        return "daF";
    case FLOAT_3:
        return "dabF";
    case FLOAT_CONSTANT_2:
    case FLOAT_MOVE_CONSTANT:
        return "drF";
    case FLOAT_CONSTANT_3:
        return "darF";
    case FLOAT_MOVE_2L:
        return "daFG";
    case FLOAT_COMPARE:
        return "abG";
    case FLOAT_COMPARE_CONSTANT:
        return "arG";
    case FLOAT_COMPARE_ZERO:
    case FLOAT_GLOBAL:
        return "aG";
    case BIT_LOAD:
        return "a";
    case BIT_STORE:
        return "d";
    case NEWS:
        return "daxD";
    case COORDINATE:
        return "dcD";
    case FLAG:
    case ALLOCATE:
    case DEALLOCATE:
    case SELECT_SET:
    case OBSERVE:
    case WRITE_ARRAY:
    case WRITE_FLOATS:
    case WRITE_PROCESSOR:
    case READ_PROCESSOR:
    case WRITE_PROCESSOR_FLOAT:
        return "";
    }
    return "";
}

static void print_real(FILE *out, double x)
{
    if (isinf(x))
        fputs(x > 0 ? "HUGE_VAL" : "-HUGE_VAL", out);
    else
        fprintf(out, "%.17g", x);
}

static void print_arguments(FILE *out, const struct instruction *in, const char *what)
{
    const char *comma = "";

    for (; *what; what++) {
        if (*what == 'd' || *what == 'a' || *what == 'b') {
            fputs(comma, out);
            print_part(out, *what == 'd' ? &in->d : *what == 'a' ? &in->a : &in->b);
        } else if (*what == 'k') {
            fprintf(out, ", %" PRId64, in->constant);
        } else if (*what == 'r') {
            fputs(", ", out);
            print_real(out, in->real);
        } else if (*what == 'x') {
            fprintf(out, ", %d, %d", in->axis, in->direction);
        } else if (*what == 'c') {
            fprintf(out, ", %d", in->axis);
        } else {
            bool is_float = *what == 'F' || *what == 'G';

            print_length(out,
                         *what == 'D' || *what == 'F' ? &in->d
                         : *what == 'B'               ? &in->b
                                                      : &in->a,
                         is_float);
        }
        comma = ", ";
    }
}

static void print_one(FILE *out, const struct program *p, const struct instruction *in, int set)
{
    const struct row_info *info = &row_table[in->row];
    uint64_t count = geometry_count(&p->sets[set]);

    fputs("    ", out);
    switch ((int)info->shape) {
    case ALLOCATE:
        fprintf(out, "f%d = %s (%d);\n", in->d.slot, info->name, in->d.bits);
        return;
    case DEALLOCATE:
        fprintf(out, "%s (f%d);\n", info->name, in->d.slot);
        return;
    case SELECT_SET:
        fprintf(out, "CM_set_vp_set (set%d);\n", in->set);
        return;
    case WRITE_ARRAY:
    case WRITE_FLOATS:
        fprintf(out,
                "{ /* data_%s (%" PRIu32
                "u, n) of program.c */\n        int n;\n        for (n = 0; n < %d; n++)\n",
                info->shape == WRITE_ARRAY ? "word" : "real", in->where, (int)count);
        fprintf(out,
                "            CM_%c_write_to_processor_1L (address (CM_current_vp_set, n), ",
                info->shape == WRITE_ARRAY ? 'u' : 'f');
        print_part(out, &in->d);
        fprintf(out,
                info->shape == WRITE_ARRAY ? ", data_word (%" PRIu32 "u, n) & %#" PRIx64
                                           : ", data_real (%" PRIu32 "u, n)",
                in->where, ((uint64_t)1 << in->d.bits % 64) - 1);
        print_length(out, &in->d, info->shape == WRITE_FLOATS);
        fputs(");\n    }\n", out);
        return;
    case WRITE_PROCESSOR:
    case WRITE_PROCESSOR_FLOAT:
        fprintf(out, "%s (address (CM_current_vp_set, %" PRIu32 "), ", info->name, in->where);
        print_part(out, &in->d);
        fputs(", ", out);
        if (info->shape == WRITE_PROCESSOR)
            fprintf(out, "%" PRId64, in->constant);
        else
            print_real(out, in->real);
        print_length(out, &in->d, info->shape == WRITE_PROCESSOR_FLOAT);
        fputs(");\n", out);
        return;
    case OBSERVE:
    case READ_PROCESSOR:
        fprintf(out,
                "{ int n; for (n = %d; n < %d; n++) printf (\"%%u\\n\", "
                "CM_u_read_from_processor_1L (address (CM_current_vp_set, n), ",
                info->shape == OBSERVE ? 0 : (int)in->where,
                info->shape == OBSERVE ? (int)count : (int)in->where + 1);
        print_part(out, &in->a);
        fprintf(out, ", %d)); }\n", in->a.bits);
        return;
    case INT_GLOBAL:
    case FLOAT_GLOBAL:
        fprintf(out, "printf (\"%s\\n\", %s (", info->shape == INT_GLOBAL ? "%u" : "%a",
                info->name);
        print_arguments(out, in, arguments((enum shape)info->shape));
        fputs("));\n", out);
        return;
    default:
        fprintf(out, "%s (", info->name);
        print_arguments(out, in, arguments((enum shape)info->shape));
        fputs(");\n", out);
        return;
    }
}

void program_print(const struct program *p, FILE *out)
{
    unsigned int used = 0;
    int set = 0;

    fputs("#include <math.h>\n#include <stdio.h>\n#include <cm/paris.h>\n\n"
          "/* LUTETIA_PROCESSORS=16; a row-major index as a send address */\n"
          "static unsigned address (CM_vp_set_id_t set, int n)\n{\n"
          "    CM_geometry_id_t g = CM_vp_set_geometry (set);\n"
          "    unsigned a = 0;\n    int axis;\n"
          "    for (axis = CM_geometry_rank (g) - 1; axis >= 0; axis--) {\n"
          "        int length = (int) CM_geometry_axis_length (g, axis);\n"
          "        a = CM_fe_deposit_news_coordinate (g, a, axis, n % length);\n"
          "        n /= length;\n    }\n    return a;\n}\n\n"
          "int main (void)\n{\n",
          out);
    for (int n = 0; n < p->count; n++)
        if (row_table[p->code[n].row].shape == ALLOCATE)
            used |= 1u << p->code[n].d.slot;
    for (int k = 0; k < p->sets_count; k++) {
        fprintf(out, "    int lengths%d[] = {", k);
        for (int axis = 0; axis < p->sets[k].rank; axis++)
            fprintf(out, "%s%d", axis ? ", " : "", p->sets[k].lengths[axis]);
        fprintf(out, "};\n    CM_vp_set_id_t set%d;\n", k);
    }
    for (int k = 0; k < PROGRAM_SLOTS; k++)
        if (used >> k & 1)
            fprintf(out, "    CM_field_id_t f%d;\n", k);
    fprintf(out, "\n    CM_init ();\n    CM_initialize_random_generator (%uu);\n",
            (unsigned int)p->seed);
    for (int k = 0; k < p->sets_count; k++)
        fprintf(out, "    set%d = CM_allocate_vp_set (CM_create_geometry (lengths%d, %d));\n",
                k, k, p->sets[k].rank);
    fputs("    CM_set_vp_set (set0);\n", out);
    for (int n = 0; n < p->count; n++) {
        if (row_table[p->code[n].row].shape == SELECT_SET)
            set = p->code[n].set;
        print_one(out, p, &p->code[n], set);
    }
    fputs("    return 0;\n}\n", out);
}
