/* demonstration_wire.c - see demonstration_wire.h. A packet is its kind, a byte, and what
 * belongs to the kind: numbers of 32 bits and doubles as this machine has them, or a text's
 * bytes. */
#include "demonstration_wire.h"

#include <visible_text.h>
#include <word_list.h>

#include <math.h>
#include <string.h>

/* What a kind has, in this order. */
struct fields {
    bool to_process, number, which, seconds, place, value, text, control;
    int which_most, text_max;
};
static const struct fields fields[DEMONSTRATION_KINDS] = {
    [DEMONSTRATION_FRAME] = {.to_process = true, .number = true, .seconds = true},
    [DEMONSTRATION_POINTER] = {.to_process = true,
                               .which = true,
                               .which_most = DEMONSTRATION_POINTERS - 1,
                               .place = true},
    [DEMONSTRATION_KEY] = {.to_process = true, .text = true, .text_max = DEMONSTRATION_KEY_MAX},
    [DEMONSTRATION_RELEASE] = {.to_process = true,
                               .text = true,
                               .text_max = DEMONSTRATION_KEY_MAX},
    [DEMONSTRATION_SET] = {.to_process = true,
                           .which = true,
                           .which_most = DEMONSTRATION_CONTROLS_MAX - 1,
                           .value = true},
    [DEMONSTRATION_SHOWN] = {.number = true, .which = true, .which_most = 1},
    [DEMONSTRATION_SAID] = {.text = true, .text_max = DEMONSTRATION_TEXT_MAX},
    [DEMONSTRATION_FAILED] = {.text = true, .text_max = DEMONSTRATION_TEXT_MAX},
    [DEMONSTRATION_CONTROL] = {.which = true,
                               .which_most = DEMONSTRATION_CONTROLS_MAX - 1,
                               .control = true},
    [DEMONSTRATION_LINE] = {.text = true, .text_max = DEMONSTRATION_TEXT_MAX}};
static const double value_most = 1e9;

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

/* Its curve, its numbers, its texts with a line end behind each. */
static uint8_t *control_bytes_put(uint8_t *at, const struct demonstration_control *c)
{
    const double numbers[4] = {c->least, c->most, c->usual, c->value};
    const char *const texts[4] = {c->name, c->unit, c->choices, c->does};
    *at++ = (uint8_t)c->curve;
    at = put(at, numbers, sizeof numbers);
    for (int i = 0; i < 4; i++) {
        at = put(at, texts[i], strlen(texts[i]));
        *at++ = '\n';
    }
    return at;
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
    if (f->value)
        at = put(at, &m->value, sizeof m->value);
    if (f->control)
        at = control_bytes_put(at, &m->control);
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

/* Up to a line end: a text that can be shown as it is. */
static void line_take(struct reading *r, int most, char *text)
{
    char line[DEMONSTRATION_NOTE_MAX + 1], shown[DEMONSTRATION_NOTE_MAX + 2];
    const size_t left = (size_t)(r->end - r->at);
    const uint8_t *end = r->good && left ? memchr(r->at, '\n', left) : NULL;
    const size_t bytes = end ? (size_t)(end - r->at) : 0;
    r->good = end && bytes <= (size_t)most;
    if (!r->good)
        return;
    memcpy(line, r->at, bytes);
    line[bytes] = '\0';
    r->good = visible_text(shown, sizeof shown, line) == bytes && strcmp(shown, line) == 0;
    memcpy(text, line, bytes + 1);
    r->at = end + 1;
}

/* Each kind of control has the numbers that it must have. */
static bool control_good(const struct demonstration_control *c)
{
    const int choices = word_list_count(c->choices);
    if (!c->name[0] || !(c->least < c->most))
        return false;
    switch (c->curve) {
    case CONTROL_CHOICE:
        return choices > 1 && c->least == 0 && c->most == choices - 1;
    case CONTROL_SWITCH:
        return choices == 0 && c->least == 0 && c->most == 1;
    case CONTROL_LINEAR:
    case CONTROL_LOGARITHMIC:
    case CONTROL_CENTRED:
        return choices == 0;
    }
    return false;
}

static void control_take(struct reading *r, struct demonstration_control *c)
{
    uint8_t curve = 0;
    take(r, &curve, 1);
    r->good = r->good && curve < CONTROL_CURVES;
    c->curve = r->good ? (enum control_curve)curve : CONTROL_LINEAR;
    c->least = number_take(r, -value_most, value_most);
    c->most = number_take(r, -value_most, value_most);
    c->usual = number_take(r, c->least, c->most);
    c->value = number_take(r, c->least, c->most);
    line_take(r, DEMONSTRATION_NAME_MAX, c->name);
    line_take(r, DEMONSTRATION_UNIT_MAX, c->unit);
    line_take(r, DEMONSTRATION_NOTE_MAX, c->choices);
    line_take(r, DEMONSTRATION_NOTE_MAX, c->does);
    r->good = r->good && control_good(c);
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
    if (f->value)
        m->value = number_take(&r, -value_most, value_most);
    if (f->control)
        control_take(&r, &m->control);
    if (f->text)
        text_take(&r, f->text_max, m->text);
    return r.good && r.at == r.end;
}
