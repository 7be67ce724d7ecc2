/* desk_words.h - texts that people see, and their translations: msgids of gettext, which
 * po/lutetia.pot lists. */
#ifndef LUTETIA_DESK_WORDS_H
#define LUTETIA_DESK_WORDS_H

#include <libintl.h>

#define _(text) gettext(text) /* as it is in the user's language */
#define N_(text) text         /* in a table: translated where it is shown */

#endif
