/* demonstration_wire.c - see demonstration_wire.h. A packet is its kind, a byte, and what
 * belongs to the kind: numbers of 32 bits and doubles as this machine has them, or a text's
 * bytes. */
#include "demonstration_wire.h"

#include <visible_text.h>

#include <math.h>
#include <string.h>

/* What a kind has, in this order. */
struct fields {
    bool to_process, number, which, seconds, place, text;
    int which_most, text_max;
};
static const struct fields fields[DEMONSTRATION_KINDS] = {
    [DEMONSTRATION_FRAME] = {.to_process = true, .number = true, .seconds = true},
    [DEMONSTRATION_POINTER] = {.to_process = true,
                               .which = true,
                               .which_most = DEMONSTRATION_POINTERS - 1,
                               .place = true},
    [DEMONSTRATION_KEY] = {.to_process = true, .text = true, .text_max = DEMONSTRATION_KEY_MAX},
    [DEMONSTRATION_SHOWN] = {.number = true, .which = true, .which_most = 1},
    [DEMONSTRATION_SAID] = {.text = true, .text_max = DEMONSTRATION_TEXT_MAX},
    [DEMONSTRATION_FAILED] = {.text = true, .text_max = DEMONSTRATION_TEXT_MAX}};

size_t demonstration_picture_bytes(int width_px, int height_px)
{
    return 3 * (size_t)width_px * (size_t)height_px;
}

size_t demonstration_memory_bytes(int width_px, int height_px)
{
    return sizeof(struct demonstration_memory) +
           2 * demonstration_picture_bytes(width_px, height_px);
}

/* ---- writing ---- */

static uint8_t *put(uint8_t *at, const void *value, size_t bytes)
{
    memcpy(at, value, bytes);
    return at + bytes;
}

size_t demonstration_message_write(const struct demonstration_message *m,
                                   uint8_t packet[DEMONSTRATION_PACKET_MAX])
{
    const struct fields *f = &fields[m->kind];
    const double place[3] = {m->x, m->y, m->pressure};
    uint8_t *at = packet;
    *at++ = (uint8_t)m->kind;
    if (f->number)
        at = put(at, &m->number, sizeof m->number);
    if (f->which)
        *at++ = (uint8_t)m->which;
    if (f->seconds)
        at = put(at, &m->seconds, sizeof m->seconds);
    if (f->place)
        at = put(at, place, sizeof place);
    if (f->text) {
        const size_t bytes = strlen(m->text), most = (size_t)f->text_max;
        at = put(at, m->text, bytes < most ? bytes : most);
    }
    return (size_t)(at - packet);
}

/* ---- reading ---- */

struct reading {
    const uint8_t *at, *end;
    bool good;
};

static void take(struct reading *r, void *value, size_t bytes)
{
    r->good = r->good && (size_t)(r->end - r->at) >= bytes;
    if (!r->good)
        return;
    memcpy(value, r->at, bytes);
    r->at += bytes;
}

static double number_take(struct reading *r, double low, double high)
{
    double value = low;
    take(r, &value, sizeof value);
    r->good = r->good && value >= low && value <= high;
    return r->good ? value : low;
}

/* As one line that can be shown: control characters and broken UTF-8 are made visible. */
static void text_take(struct reading *r, int most, char *text)
{
    char line[DEMONSTRATION_TEXT_MAX + 1];
    const size_t bytes = (size_t)(r->end - r->at);
    r->good = r->good && bytes <= (size_t)most;
    if (!r->good)
        return;
    for (size_t i = 0; i < bytes; i++)
        line[i] = r->at[i] ? (char)r->at[i] : ' ';
    line[bytes] = '\0';
    r->at = r->end;
    visible_text(text, DEMONSTRATION_TEXT_MAX + 1, line);
}

bool demonstration_message_read(const uint8_t *packet, size_t bytes, bool to_process,
                                struct demonstration_message *m)
{
    const double far = 1e6;
    *m = (struct demonstration_message){0};
    if (bytes < 1 || packet[0] < DEMONSTRATION_FRAME || packet[0] >= DEMONSTRATION_KINDS)
        return false;
    const struct fields *f = &fields[packet[0]];
    struct reading r = {packet + 1, packet + bytes, f->to_process == to_process};
    m->kind = (enum demonstration_kind)packet[0];
    if (f->number) {
        take(&r, &m->number, sizeof m->number);
        r.good = r.good && m->number > 0;
    }
    if (f->which) {
        uint8_t which = 0;
        take(&r, &which, 1);
        m->which = which;
        r.good = r.good && which <= f->which_most;
    }
    if (f->seconds)
        m->seconds = number_take(&r, 0, 1);
    if (f->place) {
        m->x = number_take(&r, -far, far);
        m->y = number_take(&r, -far, far);
        m->pressure = number_take(&r, 0, 1);
    }
    if (f->text)
        text_take(&r, f->text_max, m->text);
    return r.good && r.at == r.end;
}
