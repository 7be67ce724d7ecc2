/* damage.h - texts with a few changes by chance: other bytes, bytes from elsewhere, bytes cut
 * out or doubled, lines left out. */
#ifndef LUTETIA_TESTS_DAMAGE_H
#define LUTETIA_TESTS_DAMAGE_H

#include <stddef.h>
#include <stdint.h>

enum { DAMAGE_MOST = 2000 };

/* text: shorter than DAMAGE_MOST / 2. The same for the same number. Returns how many bytes
 * there are. */
size_t damage(const char *text, uint64_t number, char out[DAMAGE_MOST]);

#endif
