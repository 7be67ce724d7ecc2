/* kit.h - what any program in C/Paris begins and ends with: attaching the machine, and its complaints as a status.
 *
 *     if (kit_attach() != KIT_OK)
 *         die(kit_error());
 *     kit_enter(set);
 *     CM_f_add_2_1L(f, g, 23, 8);          Paris reports a call that fails to a handler and goes on without it,
 *     CM_f_sqrt_1_1L(f, 23, 8);            so what stands here runs to its end,
 *     if (kit_leave() != KIT_OK)           and the first complaint is what the caller hears
 *         die(kit_error());
 *
 * Threads. Paris's calls belong to one thread, and so do these. */
#ifndef LUTETIA_PARIS_KIT_H
#define LUTETIA_PARIS_KIT_H

#include <cm/paris.h>

enum kit_status {
    KIT_OK = 0,
    KIT_NO_DEVICE,     /* the machine could not be attached */
    KIT_NO_MEMORY,     /* of the front end or of the device */
    KIT_DEVICE_FAILED, /* it reported an error while running */
    KIT_WRONG_CALL     /* the program called Paris as it may not */
};

/* Attaches the machine if nothing has yet, and takes Paris's complaints from then on. Errors: NO_DEVICE, NO_MEMORY. */
enum kit_status kit_attach(void);

/* Forgets what failed before. */
void kit_begin(void);
/* ... and makes the VP set current. */
void kit_enter(CM_vp_set_id_t set);
/* The first failure since kit_begin(); OK if there was none. */
enum kit_status kit_leave(void);
/* Computes what is pending and waits for it, as between kit_enter() and kit_leave(). */
enum kit_status kit_finish(CM_vp_set_id_t set);

/* The failure that kit_attach(), kit_leave() or kit_finish() returned, in one line. */
const char *kit_error(void);

#endif
