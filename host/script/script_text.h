/* script_text.h - Lua's text in a growing array, and bytes as text (base64, RFC 4648). */
#ifndef LUTETIA_SCRIPT_TEXT_H
#define LUTETIA_SCRIPT_TEXT_H

#include <bytes.h>
#include <members.h>

__attribute__((format(printf, 2, 3))) void script_text_say(struct event_bytes *text,
                                                           const char *format, ...);
/* The shortest decimal that gives the number back. */
void script_text_number(struct event_bytes *text, double number);
/* As a Lua string. */
void script_text_quoted(struct event_bytes *text, const char *string);
/* "name = value" for each field that scripts can set, by the rows, after commas but behind a
 * brace. False: a number has no decimal that gives it back. */
bool script_text_fields(struct event_bytes *text, const struct members *members,
                        const void *of);

void script_text_base64(struct event_bytes *text, const uint8_t *bytes, size_t count);
/* The bytes that a text says; false: it is no such text, or there is no memory. Owns: the
 * caller frees *bytes. */
bool script_text_bytes(const char *text, size_t length, uint8_t **bytes, size_t *count);

#endif
