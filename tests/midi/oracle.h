/* oracle.h - the slow twin of the parser: sees all the bytes at once, and reads the real-time messages and the others apart.
 *
 * Real-time bytes are taken out first, each with the place where it stood. What is left is cut at its status bytes; each
 * part is read by itself, each message with the place of its last byte. The places then give the order of all. */
#ifndef LUTETIA_TESTS_MIDI_ORACLE_H
#define LUTETIA_TESTS_MIDI_ORACLE_H

#include <midi_parser.h>

#include "taken.h"

/* At the end of the bytes the source is gone. */
void oracle_parse(const uint8_t *bytes, size_t count, struct taken *out,
                  struct midi_parser_counts *counts);

/* Bytes as an instrument, a bad cable or an enemy might send them. seed: any; the same gives the same. */
void oracle_bytes(uint64_t *seed, uint8_t *bytes, size_t count);

#endif
