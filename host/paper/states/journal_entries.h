/* journal_entries.h - a journal's bytes, without files.
 *
 *     "LJRN", version                    4 bytes each; all numbers with their low byte first
 *     digest                             32: SHA-256 of the state's file; zeros: there is none
 *     description: length                8
 *       sheet_config_encode()
 *     names                              history_names_put()
 *     checksum                           8: of all this
 *
 *     entry: length, checksum            4, 8: of the number and the content
 *       number                           8: of the entry, from 0
 *       what                             1: 0 an operation, 1 one that is joined to the last;
 *                                        else the move (enum note_move)
 *       operation                        history_operation_put(), or
 *       number                           8: the move's
 */
#ifndef LUTETIA_PAPER_JOURNAL_ENTRIES_H
#define LUTETIA_PAPER_JOURNAL_ENTRIES_H

#include "history/history_internal.h"
#include "journal.h"

enum { JOURNAL_VERSION = 1, JOURNAL_DIGEST = 32, JOURNAL_ENTRY_HEAD = 12 };

struct journal_head {
    uint8_t digest[JOURNAL_DIGEST];
    struct paper_sheet_config config;
    int kinds[256]; /* of this program, of the file's */
};

void journal_head_put(struct event_bytes *b, const struct journal_head *head);
/* Errors: BAD_FILE. */
enum paper_status journal_head_get(struct event_reader *r, struct journal_head *head);

/* An operation, or a move (op NULL). */
void journal_entry_put(struct event_bytes *b, uint64_t number, const struct event_record *op,
                       bool joined, int move, long move_number);
/* Does with the sheet what the next entry tells. Errors: BAD_FILE (damaged, or impossible),
 * NO_MEMORY; r->at is then before it. */
enum paper_status journal_entry_do(struct event_reader *r, uint64_t number,
                                   const struct journal_head *head, struct paper_sheet *p);

#endif
