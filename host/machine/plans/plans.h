/* plans.h - plans: plan_kernels.c makes them, plan_run.c runs them. */
#ifndef LUTETIA_MACHINE_PLANS_H
#define LUTETIA_MACHINE_PLANS_H

#include "codegen/codegen.h"
#include "interpret/blocks.h"
#include "interpret/device_code.h"
#include "plans/choices.h"
#include "plans/explained.h"
#include "plans/families.h"
#include "watch/sums.h"

/* The quality of a plan's kernels: small work that runs once is not worth a second of
 * compiling. */
enum quality {
    INTERPRETED, /* no kernels: byte code, see interpreted.c */
    QUICK,
    OPTIMISED,
    BOXED
};

struct launch {
    struct device_kernel
        *kernel; /* held; NULL: it is compiled in the background, or there is a program */
    struct byte_code *program; /* what is interpreted; NULL: a kernel */
    struct device_code *code;  /* the same for the device; NULL: the front end performs it */
    int number;                /* for observers; may be NULL */
    struct kernel_note *note;  /* for observers; may be NULL */
    int set, vector;
    size_t strip_bytes; /* 0: not in strips */
    int strip_margin, strip_columns;
    int group, tile_width, tile_height; /* group 0: not in tiles */
    struct in_place in_place;
    bool claims; /* two of its arguments are the device's claims */
    struct kernel_argument *arguments;
    int arguments_count;
};

/* An array that a plan stores. Of launches: the one that stores it, and the last that reads
 * it. */
struct array {
    struct rows rows;
    int first, last;
};

struct plan {
    uint32_t *signature;
    uint32_t signature_length;
    uint64_t hash, used; /* used: when it was last found: plans.age */
    struct launch *launches;
    int launches_count;
    int *stored; /* the nodes that get buffers, in the order of launches */
    struct array *arrays;
    int stored_count;
    uint32_t version;
    uint64_t worked; /* processors that it has run on, by shape_work(), summed over all runs */
    uint64_t work;   /* ... in one run */
    enum quality quality;
    bool could_be_optimised, could_be_boxed, could_be_strips;
    int turns_most;
    double predicted_s; /* of a run */
    uint64_t bytes;     /* of the arrays that a run touches, while it is interpreted */
    uint64_t runs;      /* while it is interpreted */
    double spent_s;     /* ... by these */
    bool asked;         /* ... whether its kernels are at hand */
    bool sought;        /* ... whether an earlier program had them compiled (known.h) */
    bool looks_around;  /* ... it reads neighbours, so strips and turns of loops may pay */
    bool only_at_hand;  /* while it is made: nothing is compiled */
    bool later;         /* its kernels are compiled in the background */
    bool lifted;        /* kernels take numbers as arguments: codegen/numbers.h */
    bool written;       /* while it is made: none does */
    uint64_t asked_of;  /* its family's lifted kernels when it was last asked */
    uint64_t alike;     /* what it computes, while better kernels are compiled; 0: not known */
    const struct plan_form *form; /* while it is made: how its kernels are; NULL: as it pays */
    struct plan_family *family;   /* NULL: unknown */
    struct choice *choice;        /* what it would store with kernels; NULL: not known */
    struct plan *better; /* the plan whose kernels are being compiled, and which replaces
                          * this one */
    bool empty;          /* without kernels, except those of a better plan */
    bool undecided;      /* it is rehearsed, and not known yet what it stores */
    bool gone;           /* its kernels had to go; they are on disk */
    bool hopeless;       /* of many turns that do not fit one kernel */
    struct division
        *division; /* it is run in blocks, and has no kernels itself; NULL: in one piece */
    struct plan *next;
};

/* ---- plan_run.c ---- */

/* Columns of a work-item; tiles along a row. */
size_t plan_run_columns(const struct machine *m, int vector);
size_t plan_tiles_across(const struct vpset *set, int tile_width);
/* Whether new values should be written over old ones that are no longer needed. */
bool plan_in_place_wanted(const struct machine *m, const struct plan *p);
struct background;
/* The use for which a plan is requested. */
enum plan_use {
    PLAN_TO_RUN,
    /* if its kernels need not be compiled; else there is no plan, nor an error */
    PLAN_TO_RUN_AT_HAND,
    PLAN_TO_RUN_OFTEN, /* it runs often, so the best kernels are made at once */
    PLAN_TO_REHEARSE,  /* its kernels are prepared, in the background if possible; none runs
                       * now */
    PLAN_TO_REHEARSE_TURNS, /* the same for many turns of a loop, which must fit one kernel */
};
static inline bool plan_use_runs(enum plan_use use)
{
    return use == PLAN_TO_RUN || use == PLAN_TO_RUN_AT_HAND || use == PLAN_TO_RUN_OFTEN;
}

/* Plans kept, and their kernels. */
struct plans {
    struct plan **table; /* by signature; NULL: empty */
    int table_size, count;
    /* Both in units of plans' sizes (plans.c): of all that are kept; of all that were made, now
     * and when the oldest were last forgotten. */
    uint64_t units, age, begun;
    struct background *background; /* background.c; NULL: not used yet */
    struct plan *improving;        /* the plan whose better kernels are being compiled */
    struct choosing choosing;      /* what a plan stores, in a thread */
    uint64_t rehearsals_chosen;    /* ... of rehearsals, so far */
    struct plan_family **families; /* families.c; NULL: none yet */
    int families_count;
    struct describing describing;
    struct blocks_room room;              /* of the interpreter */
    struct device_kernels device_kernels; /* of the device's */
    char *dump_dir;                       /* NULL: no dumps */
    int dump_count;
    uint64_t interpreted; /* programs run, of one stage and VP set each */
    uint64_t built, kernels_in_place, kernels_in_strips, kernels_in_tiles;
    double predicted_s; /* of the plans that ran */
};

/* The nodes reached from the targets, inputs before users, and the signature: a number for
 * each node and its inputs. Evaluations with equal signatures have the same plan. */
struct reach {
    struct machine_value **nodes; /* inputs before users */
    uint32_t *signature;
    int count, capacity;
    uint32_t length;
    int signature_capacity;
};

struct targets {
    struct machine_value **values;
    int count, capacity;
};
struct plan_form;
struct plan_request {
    const struct reach *reach;
    const struct targets *targets;
    enum plan_use use;
    struct plan_family *family;   /* set by plan_get() */
    bool written;                 /* no kernel takes numbers as arguments */
    const struct choice *choice;  /* what kernels store; NULL: to be chosen */
    const struct plan_form *form; /* how kernels are made (known.h); NULL: as it pays */
};

/* Returns the plan: a new or a known one, with better kernels if these are due. NULL: error
 * set; for a plan that is not to run, it may also be impossible. */
struct plan *plan_get(struct machine *m, const struct plan_request *q);
/* The plan of that signature; NULL: there is none. And keeps one that was made elsewhere; NULL:
 * error set, and it is gone. */
struct plan *plans_find(struct machine *m, const struct reach *r);
struct plan *plans_keep(struct machine *m, struct plan *p, const struct plan_request *q);
/* Whether there are so many, or so many kernels, that the oldest should go; they go, all but
 * those used lately. Nobody else may know the plans any more. */
bool plans_are_many(const struct machine *m);
void plans_forget_oldest(struct machine *m);
/* Whether it can run as it did in that version, without being asked for. Not where better
 * kernels are due: whether they are can change at any moment, since a thread chooses what it
 * stores. */
bool plan_may_run(struct machine *m, const struct plan *p, uint32_t version);
/* Whether it has kernels, or is to get some, in a child after fork(), where none runs. */
bool plan_is_of_parent(const struct machine *m, const struct plan *p);
/* Whether its kernels are still being compiled in the background, or chosen. */
bool plan_waits(const struct machine *m, const struct plan *p);
/* Whether it was rehearsed, and should be again, since now its kernels can be requested. */
bool plan_wants_rehearsal(struct machine *m, const struct plan *p);
/* Whether its kernels are final, and as many turns take a kernel or more of each VP set for
 * each turn. */
bool plan_saves_nothing(const struct plan *p, int turns);
/* Whether it is interpreted, and done in some microseconds. */
bool plan_is_short(const struct machine *m, const struct plan *p);
/* Whether it is of many turns that do not fit one kernel. */
bool plan_is_hopeless(const struct plan *p);
/* Called between evaluations: a plan whose better kernels are all compiled gets them. Loads
 * at most one of them. */
void plans_see_to(struct machine *m);
/* How many times as much would have to be computed for each byte so that a run hardly waits for
 * memory, if more values of the same arrays were evaluated together. 0: its arrays are in the
 * caches, it reads neighbours, or it has kernels. */
double plan_waits_for_memory(const struct machine *m, const struct plan *p);
const int *plan_stored(const struct plan *p, int *count);
/* Of all that it stores together. */
uint64_t plan_stores_bytes(const struct plan *p);
/* How many of it may be cheaper in one kernel; 1: one. */
int plan_turns(const struct machine *m, const struct plan *p);

/* What is known of buffers before a foreseen run. */
struct fates {
    /* By node: its buffer is not needed afterwards, if this is the only reference. A result
     * may be stored there. */
    const bool *dies;
    /* By stored node: the caller keeps the result; others are released after use. */
    const bool *kept;
    /* Buffers that nobody needs any more, nor this plan, if there is no other reference:
     * room for results. */
    struct device_buffer *const *spare;
    int spare_count;
};

/* buffers: by node, of those in memory; stored results are added, and belong to the caller.
 * nodes: the constants. fates: NULL: nothing is known. On failure no results are added. */
enum machine_status plan_run(struct machine *m, struct plan *p, struct device_buffer **buffers,
                             struct machine_value *const *nodes, const struct fates *fates);
void plans_finish(struct machine *m);
void plan_free(struct machine *m, struct plan *p);
/* If it has kernels that were used last before then (device_kernel.used), it lets go of all its
 * kernels. */
void plan_let_go_of_old(struct machine *m, struct plan *p, uint64_t used_before);
/* Of one whose kernels are compiled in the background, the notes: with those, or without
 * (NULL). */
void plan_notes_settle(struct machine *m, struct plan *p);
bool plan_is_one_kernel(const struct plan *p);
/* later: the kernels are only requested from the background. Many turns of a loop must fit
 * one kernel, or there is no plan. */
struct plan *plan_make(struct machine *m, const struct plan_request *q, enum quality quality,
                       bool later);
/* The quality of kernels for a plan that has run on that many processors. */
enum quality plan_quality_after(const struct machine *m, uint64_t worked);
/* Whether better kernels pay by now, and can be made. */
bool plan_is_due(struct machine *m, const struct plan *p);
/* ... because it has run so often that its kernels should have its numbers in their text. */
bool plan_is_due_written(const struct machine *m, const struct plan *p);
void plan_becomes(struct machine *m, struct plan *p, struct plan *better);
/* Makes better kernels for the plan, now. Failures are ignored. */
void plan_improve(struct machine *m, struct plan *p, const struct plan_request *q,
                  enum quality quality);
/* One that is interpreted gets kernels: those at hand, or such as are compiled now or in the
 * background. */
void plan_promote(struct machine *m, struct plan *p, const struct plan_request *q);
/* One that is interpreted requests the kernels that an earlier program had compiled in this
 * form. If one of them is not there any more, nothing is requested. */
void plan_recall(struct machine *m, struct plan *p, const struct plan_request *q);
/* Drops what is being compiled in the background. */
void improve_give_up(struct machine *m);
/* Requests better kernels from the background. False: impossible. */
bool improve_begin(struct machine *m, struct plan *p, const struct plan_request *q,
                   enum quality quality);
/* ---- plan_graph.c ---- */

/* Makes room for one node of so many words at most, if there is none. False: no memory. */
enum { REACH_WORDS = 9 };
bool reach_grow(struct reach *r);
/* All nodes have been added (reach.h); those that are wanted belong to the signature, too. */
bool reach_ends(struct reach *r, const struct targets *t);
void reach_finish(struct reach *r);
/* One more; false: no memory. */
bool targets_add(struct targets *t, struct machine_value *v);

bool plan_graph_init(struct plan_graph *g, const struct plan_request *q);
/* What is stored in that stage (-1: in all) and VP set, in stages' order; how many. */
int plan_stores(const struct plan_graph *g, int stage, int set, int *stores);
/* These get arrays, by the next launch. */
void plan_arrays(const struct machine *m, struct plan *p, const struct plan_graph *g,
                 const int *stores, int count);
void plan_last_launches(struct plan *p); /* finds which launch is the last to take an array */

/* ---- plan_kernels.c ---- */

bool plan_launches_grow(struct plan *p); /* room for one more; false: no memory */
/* Of the launch, which had none. */
void launch_takes(struct launch *l, struct device_kernel *kernel);

/* ---- interpreted.c ---- */

/* A plan that is run as byte code. NULL: that cannot be, or does not pay; there is no error. */
struct plan *interpreted_make(struct machine *m, const struct plan_request *q);
/* What its runs have cost, and are likely to cost, is worth a look at kernels, or compiling
 * them. */
bool interpreted_is_due(const struct machine *m, const struct plan *p);
/* What a run with kernels would save of a run as byte code, of which there has been one. */
double interpreted_saves_s(const struct machine *m, const struct plan *p);
/* Whether to look now for what an earlier program had compiled (known.h): once for each plan,
 * where kernels are compiled in the background. */
bool interpreted_seeks(struct machine *m, const struct plan *p);
/* Its family has got kernels since it was asked whether there are any. */
bool interpreted_asks(const struct plan *p);
/* The same with kernels that need not be compiled; NULL: there are none. */
struct plan *interpreted_at_hand(struct machine *m, const struct plan_request *q);

void dump_text(struct machine *m, int number, const char *suffix, const char *options,
               const char *text);
void dump_graph(struct machine *m, int number, const struct plan_graph *g);

#endif
