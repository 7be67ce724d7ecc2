/* kit.h - the frame of a program in C/Paris: attaching the machine, and Paris's error messages
 * as a status.
 *
 *     if (kit_attach() != KIT_OK)
 *         die(kit_error());
 *     kit_enter(set);
 *     CM_f_add_2_1L(f, g, 23, 8);          Paris reports a call that fails to a handler and
 *                                          goes on without it,
 *     CM_f_sqrt_1_1L(f, 23, 8);            so what stands here runs to its end,
 *     if (kit_leave() != KIT_OK)           and the first complaint is what the caller hears
 *         die(kit_error());
 *
 * Threads. All calls of Paris and of this header are made by one thread. */
#ifndef LUTETIA_PARIS_KIT_H
#define LUTETIA_PARIS_KIT_H

#include <cm/paris.h>

enum kit_status {
    KIT_OK = 0,
    KIT_NO_DEVICE,     /* the machine could not be attached */
    KIT_NO_MEMORY,     /* the front end's, or the device's */
    KIT_DEVICE_FAILED, /* it reported an error while running */
    KIT_WRONG_CALL     /* the program called Paris as it may not */
};

/* Attaches the machine if it is not attached yet, and handles Paris's error messages from
 * then on. Errors: NO_DEVICE, NO_MEMORY. */
enum kit_status kit_attach(void);

/* Forgets earlier failures. */
void kit_begin(void);
/* kit_begin(), and makes the VP set current. */
void kit_enter(CM_vp_set_id_t set);
/* The first failure since kit_begin(); OK if there was none. */
enum kit_status kit_leave(void);
/* Computes everything pending and waits for it; includes kit_enter() and kit_leave(). */
enum kit_status kit_finish(CM_vp_set_id_t set);

/* The message, in one line, of the failure that kit_attach(), kit_leave() or kit_finish()
 * returned. */
const char *kit_error(void);

#endif
