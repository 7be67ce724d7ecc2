/* ranks.h - the processes that an MPI starter has made of one program.
 *
 *     rank 0            the program, the front end, the first block of each VP set that is cut
 *     ranks above 0     one more block each: they perform commands, and never come to main()
 *
 * A command is a few numbers, and bytes (payload). Commands are gathered, and sent many at a
 * time to all ranks; so a rank that waits for another one never waits for something that is not
 * on its way. What a command needs of long data follows it, in a message of its own.
 *
 *     rank 0     RUN RUN | MOVE OUT, IN | RUN ...        at once; without waiting for an answer
 *     rank 1     performs them in this order
 *
 * Threads: those of the one machine that has the ranks. */
#ifndef LUTETIA_MACHINE_RANKS_H
#define LUTETIA_MACHINE_RANKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RANKS_MOST = 64, RANKS_NAME_BYTES = 64 };

/* ---- processes.c ---- */

/* How many ranks there are (1: no starter, or it made one process), and which one this is. A
 * child after fork() is no rank. */
int ranks_count(void);
int ranks_mine(void);
/* How many are on this computer, this one among them. */
int ranks_on_node(void);
bool ranks_are_ours(void);

/* ---- starter.c ---- */

struct ranks_starter {
    int count, mine;  /* as the starter's variables say */
    const char *name; /* of the variable that says it */
};
/* Whether a starter has made several processes of this program. */
bool ranks_starter(struct ranks_starter *out);
/* The same where the processes should be ranks: not with LUTETIA_RANKS=0. */
bool ranks_wanted(struct ranks_starter *out);
/* Programs that this one starts are none of these processes. */
void ranks_starter_forget(void);

/* ---- hello.c ---- */

/* Starts MPI, and sees to it that all ranks are alike. False: a line has been printed, by one
 * of them. */
bool ranks_join(const struct ranks_starter *starter);

/* ---- commands.c ---- */

enum ranks_command_of {
    RANKS_CREATE,  /* a machine: processors; payload: the device's name */
    RANKS_DESTROY, /* it */
    RANKS_SET,     /* a VP set: id; payload: it */
    RANKS_GET,     /* an array: id, bytes, first */
    RANKS_DROP,    /* it: id */
    RANKS_FILL,    /* id, bytes of the pattern; payload: it */
    RANKS_COPY,    /* from id, to id, bytes */
    RANKS_READ,    /* id, at, bytes of a row, pitch, rows: a reply */
    RANKS_WRITE,   /* id, at, bytes of a row, pitch, rows; data */
    RANKS_OUT,     /* planes to another rank: id, at, bytes, rank */
    RANKS_IN,      /* planes from another rank: id, at, bytes, rank */
    RANKS_PLAN,    /* a portion: id; payload: its drafts */
    RANKS_PREPARE, /* its plan: id, use */
    RANKS_RUN,     /* id; payload: ids of arrays, numbers, ids of results */
    RANKS_FORGET,  /* it: id */
    RANKS_REDUCE,  /* payload: ops/sums_far.c; a reply */
    RANKS_ROUTE,   /* sends and gets; payload: ops/all_to_all_far.c */
    RANKS_EACH, /* work of a block: kind, VP set, the result; payload: arrays, and the work */
    RANKS_END,
    RANKS_COMMANDS
};

enum { RANKS_NUMBERS = 5 };

struct ranks_command {
    uint32_t what;
    uint32_t payload; /* bytes that follow it; then as many as make it a multiple of 8 */
    uint64_t of[RANKS_NUMBERS];
};

/* Rank 0's. A payload that is longer than PAYLOAD_MOST goes as data. */
enum { RANKS_PAYLOAD_MOST = 32768 };
void ranks_command(int rank, struct ranks_command command, const void *payload);
void ranks_command_all(struct ranks_command command, const void *payload);
/* All that was commanded is on its way. */
void ranks_flush(void);
/* Data of the last command, which is sent first. */
void ranks_data(int rank, const void *data, size_t bytes);
/* What a rank answers, after a flush. */
void ranks_reply_take(int rank, void *out, size_t bytes);

/* Other ranks'. The next command: it is there until the next call, and so is its payload. */
const struct ranks_command *ranks_next(const void **payload);
void ranks_data_take(void *out, size_t bytes);
void ranks_reply(const void *bytes, size_t count);

/* ---- faults.c ---- */

/* From now on it is no fault that processes end. */
void faults_are_over(void);

#endif
