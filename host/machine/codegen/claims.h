/* claims.h - the part of a kernel's text by which work-groups claim what they compute: see
 * kernels/claims.cl. */
#ifndef LUTETIA_MACHINE_CLAIMS_H
#define LUTETIA_MACHINE_CLAIMS_H

#include "codegen/body.h"

/* Adds the two arguments. */
void claims_add(struct arguments *to, bool *failed);
/* Declares one of them. False: it is another argument. */
bool claims_declare(struct text *t, const struct kernel_argument *a);
/* The beginning of a kernel's body: int down, across, the work-group's place; claimed or its
 * own. */
const char *claims_place(bool claimed);

#endif
