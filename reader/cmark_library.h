/* cmark_library.h - cmark-gfm, loaded when the first document is read: most programs read
 * none, and it takes time to load.
 *
 * cmark.node_next() is cmark-gfm's cmark_node_next(). A name that is not in a table yet is
 * added there. */
#ifndef LUTETIA_CMARK_LIBRARY_H
#define LUTETIA_CMARK_LIBRARY_H

#include <cmark-gfm-core-extensions.h>
#include <cmark-gfm.h>
#include <stdbool.h>

/* clang-format off */
#define CMARK_NAMES(X)                                                                         \
    X(find_syntax_extension)                                                                   \
    X(iter_free) X(iter_get_node) X(iter_new) X(iter_next)                                     \
    X(node_first_child) X(node_free) X(node_get_end_line) X(node_get_fence_info)               \
    X(node_get_heading_level) X(node_get_list_delim) X(node_get_list_start)                    \
    X(node_get_list_type) X(node_get_literal) X(node_get_start_line) X(node_get_type)          \
    X(node_get_title) X(node_get_type_string) X(node_get_url) X(node_next) X(node_previous)                      \
    X(parser_attach_syntax_extension) X(parser_feed) X(parser_finish) X(parser_free)           \
    X(parser_new)
#define CMARK_EXTENSION_NAMES(X)                                                               \
    X(gfm_core_extensions_ensure_registered) X(gfm_extensions_get_table_alignments)            \
    X(gfm_extensions_get_table_columns) X(gfm_extensions_get_tasklist_item_checked)
/* clang-format on */

#define CMARK_MEMBER(name) __typeof__(cmark_##name) *name;
extern struct cmark_library {
    CMARK_NAMES(CMARK_MEMBER) CMARK_EXTENSION_NAMES(CMARK_MEMBER)
} cmark;

/* Loads it, with its extensions registered. False: it cannot be loaded; *why is the reason.
 * Any thread. */
bool cmark_load(const char **why);

#endif
