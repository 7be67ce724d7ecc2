/* clang-format off */
/* A small library of vectors in the style of 1990, with its tests. A vector of n elements is a
 * field in the VP set of ratio 1, with room for k elements in each processor, k a power of two.
 * An operation copies its arguments to the stack, makes aliases of them in the set of ratio k,
 * computes there, and copies the result back. All run in both safety modes. */
#include <stdio.h>
#include <stdlib.h>
#include <cm/paris.h>

#define PROCESSORS 64
#define RATIOS 8
#define MOST (PROCESSORS << (RATIOS - 1))
#define INTEGER 32
#define FLAG 1
#define SINGLE 23, 8

#define PASTE(a, b, c) a##b##c
#define STEP(field, bits) field = CM_add_offset_to_field_id (field, bits)

typedef int vector;

static CM_vp_set_id_t sets[RATIOS];
static int number_of;           /* each processor's own */
static int failures = 0, complaints = 0;

/* ---- the machine ---- */

static void complain (message)
    const char *message;
{
    fprintf (stderr, "%s\n", message);
    complaints++;
}

static int logarithm (k)
    int k;
{
    int l = 0;
    while ((1 << l) < k)
        l++;
    return l;
}

static int each (n)
    int n;
{
    int k = 1;
    while (k * (int) CM_physical_processors_limit < n)
        k *= 2;
    return k;
}

static void begin_vectors (safety)
    int safety;
{
    int i;
    CM_axis_descriptor_t axes[1];

    CM_init ();
    CM_set_safety_mode ((unsigned) safety);
    axes[0] = (CM_axis_descriptor_t) calloc (1, sizeof (struct CM_axis_descriptor));
    axes[0]->weight = 1;
    axes[0]->ordering = CM_send_order;
    for (i = 0; i < RATIOS; i++) {
        axes[0]->length = CM_physical_processors_limit << i;
        sets[i] = CM_allocate_vp_set (CM_create_detailed_geometry (axes, 1));
    }
    free ((char *) axes[0]);
    CM_set_vp_set (sets[0]);
    CM_set_context ();
    number_of = CM_allocate_heap_field (INTEGER);
    CM_my_send_address (number_of);
}

static void all_processors ()
{
    CM_set_vp_set (sets[0]);
    CM_set_context ();
}

/* Selects the set of ratio k and turns on its first n VPs. The set of ratio 1 must be selected
 * at the call. */
static void elements (k, n)
    int k, n;
{
    CM_field_id_t bits, alias;

    if (k == 1) {
        CM_u_lt_constant_1L (number_of, (unsigned) n, INTEGER);
        CM_logand_context_with_test ();
        return;
    }
    bits = CM_allocate_stack_field (k);
    CM_u_move_zero_always_1L (bits, k);
    CM_u_lt_constant_1L (number_of, (unsigned) (n / k), INTEGER);
    CM_logand_context_with_test ();
    CM_lognot_1_1L (bits, k);
    CM_set_context ();
    CM_u_eq_constant_1L (number_of, (unsigned) (n / k), INTEGER);
    CM_logand_context_with_test ();
    CM_lognot_1_1L (bits, n % k);
    CM_set_vp_set (sets[logarithm (k)]);
    alias = CM_make_field_alias (bits);
    CM_load_context (alias);
    CM_remove_field_alias (alias);
    CM_deallocate_stack_through (bits);
}

#define COPIES(name, letter, bits, lengths)                             \
static void name (to, from, k)                                          \
    int to, from, k;                                                    \
{                                                                       \
    while (k-- > 0) {                                                   \
        PASTE (CM, letter, move_always_1L) (to, from, lengths);         \
        STEP (to, bits);                                                \
        STEP (from, bits);                                              \
    }                                                                   \
}
COPIES (copy_integers, _s_, INTEGER, INTEGER)
COPIES (copy_flags, _u_, FLAG, FLAG)
COPIES (copy_floats, _f_, INTEGER, SINGLE)

/* ---- to and from the front end ---- */

static vector new_vector (n, bits)
    int n, bits;
{
    /* strict: no field is empty */
    return n ? CM_allocate_heap_field (each (n) * bits) : CM_allocate_heap_field (CM_safety_mode () ? 1 : 0);
}

static void transfer (v, array, n, bits, writes)
    vector v;
    int *array, n, bits, writes;
{
    int offset = 0, start = 0, axis = 0, k = each (n), alias;

    CM_set_vp_set (sets[logarithm (k)]);
    alias = CM_make_field_alias (v);
    if (writes)
        CM_u_write_to_news_array_1L (array, &offset, &start, &n, &axis, alias, bits, 1, &n, CM_32_bit);
    else
        CM_u_read_from_news_array_1L (array, &offset, &start, &n, &axis, alias, bits, 1, &n, CM_32_bit);
    CM_remove_field_alias (alias);
    all_processors ();
}

/* ---- operations ---- */

/* Adds vectors with a loop over the elements of one processor. */
static void add (d, a, b, n)
    vector d, a, b;
    int n;
{
    int k;
    for (k = each (n); k > 0; k--) {
        CM_s_add_3_1L (d, a, b, INTEGER);
        STEP (d, INTEGER);
        STEP (a, INTEGER);
        STEP (b, INTEGER);
    }
}

static void count_up (d, n)
    vector d;
    int n;
{
    int k = each (n), t = CM_allocate_stack_field (k * INTEGER), alias;

    elements (k, n);
    alias = CM_make_field_alias (t);
    CM_my_send_address (alias);
    all_processors ();
    copy_integers (d, t, k);
    CM_remove_field_alias (alias);
    CM_deallocate_stack_through (t);
}

#define PERMUTES(name, copies, bits)                                    \
static void name (d, s, index, n, m, gets)                              \
    vector d, s, index;                                                 \
    int n, m, gets;                                                     \
{                                                                       \
    int k = each (n), l = each (m), i = gets ? m : n;                   \
    int ts = CM_allocate_stack_field (k * bits);                        \
    int td = CM_allocate_stack_field (l * bits);                        \
    int ti = CM_allocate_stack_field (each (i) * INTEGER);              \
    int as, ad, ai;                                                     \
    copies (ts, s, k);                                                  \
    copies (td, d, l);                                                  \
    copy_integers (ti, index, each (i));                                \
    CM_set_vp_set (sets[logarithm (gets ? k : l)]);                     \
    if (gets)                                                           \
        as = CM_make_field_alias (ts);                                  \
    else                                                                \
        ad = CM_make_field_alias (td);                                  \
    all_processors ();                                                  \
    elements (each (i), i);                                             \
    ai = CM_make_field_alias (ti);                                      \
    if (gets) {                                                         \
        ad = CM_make_field_alias (td);                                  \
        CM_get_1L (ad, ai, as, bits);                                   \
    } else {                                                            \
        as = CM_make_field_alias (ts);                                  \
        CM_send_1L (ad, ai, as, bits, CM_no_field);                     \
    }                                                                   \
    all_processors ();                                                  \
    copies (d, td, l);                                                  \
    CM_remove_field_alias (as);                                         \
    CM_remove_field_alias (ad);                                         \
    CM_remove_field_alias (ai);                                         \
    CM_deallocate_stack_through (ts);                                   \
}
PERMUTES (permute_integers, copy_integers, INTEGER)
PERMUTES (permute_flags, copy_flags, FLAG)
PERMUTES (permute_floats, copy_floats, INTEGER)

static int extract (v, i, n)
    vector v;
    int i, n;
{
    int k = each (n), x;
    x = CM_s_read_from_processor_1L (i / k, CM_add_offset_to_field_id (v, i % k * INTEGER), INTEGER);
    return x;
}

static void replace (v, i, x, n)
    vector v;
    int i, x, n;
{
    int k = each (n);
    CM_s_write_to_processor_1L (i / k, CM_add_offset_to_field_id (v, i % k * INTEGER), x, INTEGER);
}

/* Counts how often each of m numbers occurs in v, by sends with addition that collide. */
static void histogram (d, v, n, m)
    vector d, v;
    int n, m;
{
    int k = each (n), l = each (m), td = CM_allocate_stack_field (l * INTEGER);
    int tv = CM_allocate_stack_field (k * INTEGER), one, ad, av;

    CM_u_move_zero_always_1L (td, l * INTEGER);
    copy_integers (tv, v, k);
    CM_set_vp_set (sets[logarithm (l)]);
    ad = CM_make_field_alias (td);
    all_processors ();
    elements (k, n);
    av = CM_make_field_alias (tv);
    one = CM_allocate_stack_field (INTEGER);
    CM_u_move_constant_1L (one, 1, INTEGER);
    CM_send_with_u_add_1L (ad, av, one, INTEGER, CM_no_field);
    all_processors ();
    copy_integers (d, td, l);
    CM_deallocate_stack_through (td);
}

/* ---- what is right ---- */

static int in[MOST], out[MOST], index_of[MOST], right[MOST];

static void compare (what, n)
    char *what;
    int n;
{
    int i;
    for (i = 0; i < n; i++)
        if (out[i] != right[i]) {
            fprintf (stderr, "%s of %d: element %d is %d, not %d\n", what, n, i, out[i], right[i]);
            failures++;
            return;
        }
}

/* Packs: each flagged element goes to the place given by the sum of the flags before it. */
static void exercise_pack (a, b, c, f, n)
    vector a, b, c, f;
    int n;
{
    int i, total = 0;

    transfer (f, out, n, FLAG, 0);
    for (i = 0; i < n; i++) {
        index_of[i] = out[i] ? total : n - 1 - (i - total);
        right[index_of[i]] = in[i];
        total += out[i];
    }
    transfer (b, index_of, n, INTEGER, 1);
    permute_integers (c, a, b, n, n, 0);
    transfer (c, out, n, INTEGER, 0);
    compare ("pack", n);
}

/* Counts the lengths of segments by sends to their starts, between sets of different ratios. */
static void exercise_segments (b, n)
    vector b;
    int n;
{
    vector c;
    int i, m = n / 9 + 1;

    for (i = 0; i < n; i++)
        index_of[i] = i * 11 % m;
    for (i = 0; i < m; i++)
        right[i] = 0;
    for (i = 0; i < n; i++)
        right[index_of[i]]++;
    transfer (b, index_of, n, INTEGER, 1);
    c = new_vector (m, INTEGER);
    histogram (c, b, n, m);
    transfer (c, out, m, INTEGER, 0);
    compare ("lengths of segments", m);
    CM_deallocate_heap_field (c);
}

static void exercise (n)
    int n;
{
    vector a = new_vector (n, INTEGER), b = new_vector (n, INTEGER), c = new_vector (n, INTEGER);
    vector f = new_vector (n, FLAG), g = new_vector (n, FLAG);
    int i;

    for (i = 0; i < n; i++) {
        in[i] = i * 40503 + 7;
        index_of[i] = (i * 5 + 3) % n;
        while (n % 5 == 0 && i == 0)
            break;
    }
    if (n % 5 == 0)
        for (i = 0; i < n; i++)
            index_of[i] = n - 1 - i;
    transfer (a, in, n, INTEGER, 1);
    transfer (b, index_of, n, INTEGER, 1);

    permute_integers (c, a, b, n, n, 0);
    for (i = 0; i < n; i++)
        right[index_of[i]] = in[i];
    transfer (c, out, n, INTEGER, 0);
    compare ("permute", n);
    permute_floats (c, a, b, n, n, 1);
    for (i = 0; i < n; i++)
        right[i] = in[index_of[i]];
    transfer (c, out, n, INTEGER, 0);
    compare ("back permute", n);
    permute_integers (c, c, b, n, n, 0);
    add (c, c, a, n);
    add (c, c, c, n);
    for (i = 0; i < n; i++)
        right[i] = 4 * in[i];
    transfer (c, out, n, INTEGER, 0);
    compare ("there and back, and sums", n);

    for (i = 0; i < n; i++)
        out[i] = i % 3 == 0 || i % 7 == 1;
    transfer (f, out, n, FLAG, 1);
    permute_flags (g, f, b, n, n, 0);
    for (i = 0; i < n; i++)
        right[index_of[i]] = out[i];
    transfer (g, out, n, FLAG, 0);
    compare ("permuted flags", n);

    exercise_pack (a, b, c, f, n);
    count_up (c, n);
    replace (c, n / 2, -12345, n);
    for (i = 0; i < n; i++)
        right[i] = i == n / 2 ? -12345 : i;
    transfer (c, out, n, INTEGER, 0);
    compare ("index with one replaced", n);
    if (extract (c, n / 2, n) != -12345 || extract (c, n - 1, n) != right[n - 1])
        failures++;

    exercise_segments (b, n);
    CM_deallocate_heap_field (a);
    CM_deallocate_heap_field (b);
    CM_deallocate_heap_field (c);
    CM_deallocate_heap_field (f);
    CM_deallocate_heap_field (g);
}

main ()
{
    static int sizes[] = {1, 5, PROCESSORS, PROCESSORS + 3, 4 * PROCESSORS, 1000, 2048, 5003, MOST};
    int safety, i, none;

    CM_set_error_handler (complain);
    CM_attach_to_processors (PROCESSORS);
    for (safety = 0; safety < 2; safety++) {
        begin_vectors (safety);
        for (i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
            exercise (sizes[i]);
        none = new_vector (0, INTEGER);
        copy_integers (none, none, 0);
        CM_deallocate_heap_field (none);
    }
    if (failures == 0 && complaints == 0)
        printf ("vectors_1990: %d processors, up to %d elements, all right\n",
                CM_physical_processors_limit, MOST);
    return failures != 0 || complaints != 0;
}
