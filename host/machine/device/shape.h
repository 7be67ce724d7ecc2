/* shape.h - what generated code should look like on a device, and what things cost there.
 *
 * All numbers about hardware are here (test machine_hardware): those of the front end's
 * processor, and those of a device, of which costs_by_driver.c has a row for each kind of
 * device and driver, and says where each row comes from. Some of them `lutetia tune` chooses by
 * measuring (enum machine_knob), some the device tells. `lutetia bench model` measures programs
 * beside what follows from the costs. */
#ifndef LUTETIA_MACHINE_SHAPE_H
#define LUTETIA_MACHINE_SHAPE_H

#include <stddef.h>

#include "base/crew.h"
#include "machine.h"

/* What the front end's own code is laid out for: numbers of its processor, which no device
 * tells. */
enum {
    LINE_BYTES = 64, /* of a cache */
    PAGE_BYTES = 4096,
    /* Code that is fetched ahead, device/code_pages.h: at a time, since who wants more memory
     * waits meanwhile; on each side of a function, for the machine and C/Paris are linked one
     * after the other and have less; and what almost any call needs, which is less than a
     * processor's own cache. */
    CODE_PIECE_BYTES = 128 << 10,
    CODE_SIDE_BYTES = 2 << 20,
    CODE_NEAR_BYTES = 448 << 10,
    /* Arrays up to such a size are parts of a chunk of such a size: device/chunks.h. */
    SMALL_ARRAY_BYTES = 32 << 10,
    SMALL_CHUNK_BYTES = 512 << 10,
    /* The interpreter's registers have so many bytes at least: a page that is written for the
     * first time costs more than a step. */
    REGISTERS_LEAST_BYTES = 32 << 10,
    /* A step for a window of the lanes takes longer to begin, so it leaves out so many lanes at
     * least. */
    WINDOW_LANES = 128,
    /* A processor looks ahead over some loads only. In an array of so many bytes and more the
     * interpreter fetches places so many lanes ahead; the front end's router fetches
     * destinations so many messages ahead. */
    GATHER_FAR_BYTES = 8 << 20,
    GATHER_AHEAD_LANES = 64,
    MESSAGES_AHEAD = 64,
    /* Sends to few processors, ops/near_few.h: the most bytes of a table, and of each of
     * several, which are all in the nearest cache; and the least senders for a processor, or to
     * join the tables takes longer. */
    TABLE_BYTES = 32 << 10,
    TABLE_NEAR_BYTES = 8 << 10,
    TABLE_SENDERS = 16
};

struct device_shape {
    /* Work-items. */
    int vector;      /* lanes of 32 bits in each; 1 on a GPU */
    int halo;        /* columns of padding, where vectors are used */
    int run_columns; /* of each: a multiple of the vector, but on a GPU */
    int strips_each; /* for each unit */
    int units;       /* that compute at the same time */
    bool narrow;     /* kernels may have lanes of 8 or 16 bits */
    bool claims;     /* a thread computes the same places in each kernel: kernels/claims.cl */
    bool keeps_nan;  /* see enum op_nan */
    bool streams;    /* large arrays are stored past the caches */
    /* The cost model, in nanoseconds. */
    double op_ns;        /* one vector instruction, for an element */
    double byte_ns;      /* one byte to or from memory */
    double near_byte_ns; /* one byte to or from a cache, or local memory */
    double launch_ns;    /* one launch */
    /* Strips, and turns of a loop at once. */
    int strip_columns; /* the most, a multiple of the vector */
    int strip_least;   /* ... and the least */
    int near_bytes;    /* of a cache, which rings should not fill */
    /* of the stages in one loop: with more there are too few registers, and nothing is won */
    int pass_cost;
    int turns;                     /* of a loop at once */
    bool no_strips, always_strips; /* or tiles: see choose.c; for tests */
    /* Tiles. */
    int group;                   /* work-items; 0: there are no tiles */
    int local_bytes;             /* of local memory, for a work-group */
    int tile_width, tile_height; /* forced; 0: free */
    /* Caches. */
    int arrays_foreseen; /* of more, hardware does not fetch the next rows by itself */
    /* of fewer, all arrays together, kernels of rows fetch nothing ahead: they are near */
    double fetch_bytes;
    double stream_bytes;       /* of more, all arrays together, storing past the caches pays */
    double stream_lanes_bytes; /* ... for the interpreter */
    double in_place_bytes; /* of more, writing over what is read pays: fewer are near anyway */
    /* Arrays: device/buffers.c. */
    size_t large_page_bytes; /* arrays as large are in pages as large */
    size_t skew_bytes; /* from where an array begins in its page to where the next one does */
    size_t skew_page_bytes;  /* ... until it has gone so far; */
    size_t skew_large_bytes; /* in large pages, so far */
    uint64_t pool_bytes;     /* the most that are kept for arrays to come */
    /* Work-items of kernels written by hand. */
    int call_columns, call_processors; /* of each */
    int send_shares;   /* that share out the destinations of a send; 0: one for each unit */
    int scatter_units; /* with so many or fewer, sends go from senders, not from destinations */
    int scan_run;      /* elements of a line for each; 0: as units have use for */
    int fill_run;      /* ... where a scan is carried on */
    int scan_run_least; /* ... at least, where units have use for shorter ones */
    int sort_chunk; /* elements of a line that are sorted together; 0: as units have use for */
    int sort_short,
        /* lines up to here are sorted by digits of 4 bits, from here by 11, others by 8 */
        sort_long;
    /* The queue: kernels in it, and while better ones are built. */
    int kernels_ahead, kernels_ahead_building;
    /* A text of so many bytes is loaded from the driver's cache by a thread: that takes over 10
     * milliseconds. */
    size_t load_aside_bytes;
    /* What a graph of so many nodes times shifts stores is chosen by a thread: a node and a
     * shift take the search some 150 ns together, so many 2.5 ms. */
    size_t choose_aside;
    /* The front end's own threads, in nanoseconds: for a byte that is moved, and for an
     * element. */
    double move_ns, reduce_ns, rank_ns, send_ns, reshape_ns, scan_ns, scan_vector_ns, fill_ns;
    /* a line that takes one thread so long is cut for several, even if they sleep */
    double scan_cut_ns;
    int rank_alone_most;     /* longer lines are ranked by all threads together */
    struct crew_costs share; /* which work threads share out */
    /* The interpreter, in nanoseconds for a lane: a step that is a loop, for each unit of an
     * operation's cost on top, a gather on top, a pick on top; a step lane by lane, of floats'
     * functions and of all else. */
    double loop_ns, loop_cost_ns, gather_ns, pick_ns, each_math_ns, each_ns;
    /* ... a step of the device's own interpreter (kernels/interpret.cl), for a processor */
    double step_ns;
    /* processors of a set whose arrays are not in the caches: they are fetched ahead */
    uint64_t ahead_from;
    /* sets of up to so many, halos included, are computed at once where nothing repeats */
    uint64_t at_once_lanes;
    /* what the front end interprets in less time is as soon done as noted: run/record.c */
    double short_ns;
    /* When plans get kernels (plans/interpreted.c): nanoseconds of a launch and its wait, of
     * the search for a plan and its text, of a compiler for a kernel and for each operation in
     * it; the part that a kernel takes of the interpreter's time; the least time of a plan of
     * which many turns can be one kernel. */
    double wait_ns, text_ns, compile_ns, compile_op_ns, kernel_part, turns_from_ns;
    /* processors of so small a set count as so many, since a launch takes as long:
     * plans/improve.c */
    uint64_t work_least;
    const char *from; /* where these numbers come from */
};

/* What is usual for a driver, by the name of its OpenCL platform, but for what the device
 * tells. A CPU's op_ns is that of an instruction, of however many lanes: costs_by_driver.c. */
struct device_shape shape_by_driver(bool is_cpu, const char *platform);

/* Bits of a digit that lines of that length are sorted by; at most 11. */
int shape_sort_digit(const struct device_shape *shape, int length);

/* Whether the interpreter stores past the caches what takes so many bytes, with all that is
 * read. */
bool shape_streams_lanes(const struct device_shape *shape, double bytes);

/* What a kernel's run on so many processors counts as, where it is asked how much a plan has
 * run. */
uint64_t shape_work(const struct device_shape *shape, uint64_t processors);

/* A cost in the terms of struct machine_tuning. */
double shape_cost_ns(const struct device_shape *shape, enum machine_cost cost);

#endif
