/* fuzz_messages.c - random bytes as what a demonstration's process and who looks at it say to
 * each other, and valid packets with bytes changed. What is read is within its ranges, is
 * written again, and is then read as the same; the rest is refused. The seeds are the same in
 * every run, or libFuzzer's with -DLUTETIA_FUZZ_TARGET. */
#include <demonstration_wire.h>

#include "../must.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static bool is_line(const char *text)
{
    for (const char *c = text; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 127)
            return false;
    return true;
}

static void control_checked(const struct demonstration_control *c)
{
    must(c->name[0] && strlen(c->name) <= DEMONSTRATION_NAME_MAX && is_line(c->name));
    must(strlen(c->unit) <= DEMONSTRATION_UNIT_MAX && is_line(c->unit));
    must(strlen(c->does) <= DEMONSTRATION_NOTE_MAX && is_line(c->does));
    must(strlen(c->choices) <= DEMONSTRATION_NOTE_MAX && is_line(c->choices));
    must(c->least < c->most && c->least >= -1e9 && c->most <= 1e9);
    must(c->usual >= c->least && c->usual <= c->most);
    must(c->value >= c->least && c->value <= c->most);
    must((unsigned)c->curve < CONTROL_CURVES);
    must(c->curve != CONTROL_CHOICE || strchr(c->choices, ' '));
}

static void message_check(const struct demonstration_message *m, bool to_process)
{
    must(m->kind >= DEMONSTRATION_FRAME && m->kind < DEMONSTRATION_KINDS);
    must((m->kind <= DEMONSTRATION_SET) == to_process);
    if (m->kind == DEMONSTRATION_CONTROL)
        control_checked(&m->control);
    must(m->seconds >= 0 && m->seconds <= 1);
    must(m->x >= -1e6 && m->x <= 1e6 && m->y >= -1e6 && m->y <= 1e6);
    must(m->pressure >= 0 && m->pressure <= 1);
    const bool control = m->kind == DEMONSTRATION_SET || m->kind == DEMONSTRATION_CONTROL;
    must(m->which >= 0 &&
         m->which < (control ? DEMONSTRATION_CONTROLS_MAX : (int)DEMONSTRATION_POINTERS));
    must(m->value >= -1e9 && m->value <= 1e9);
    must(m->kind != DEMONSTRATION_SHOWN || m->which < 2);
    must((m->kind != DEMONSTRATION_SHOWN && m->kind != DEMONSTRATION_FRAME) || m->number > 0);
    must(strlen(m->text) <= DEMONSTRATION_TEXT_MAX && is_line(m->text));
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    for (int to_process = 0; to_process < 2; to_process++) {
        struct demonstration_message m, again;
        uint8_t packet[DEMONSTRATION_PACKET_MAX];
        if (!demonstration_message_read(bytes, count, to_process, &m))
            continue;
        must(count >= 1 && count <= DEMONSTRATION_PACKET_MAX);
        message_check(&m, to_process);
        const size_t written = demonstration_message_write(&m, packet);
        must(written <= sizeof packet);
        must(demonstration_message_read(packet, written, to_process, &again));
        message_check(&again, to_process);
        must(again.kind == m.kind && again.number == m.number && again.which == m.which);
        must(memcmp(&again.seconds, &m.seconds, sizeof m.seconds) == 0);
        must(memcmp(&again.x, &m.x, sizeof m.x) == 0);
        must(memcmp(&again.value, &m.value, sizeof m.value) == 0);
        must(strcmp(again.control.name, m.control.name) == 0 &&
             strcmp(again.control.choices, m.control.choices) == 0 &&
             again.control.curve == m.control.curve);
        must(again.control.least == m.control.least && again.control.most == m.control.most &&
             again.control.value == m.control.value);
    }
    return 0;
}

#ifndef LUTETIA_FUZZ_TARGET
static uint32_t chance(void)
{
    static uint32_t state = 2463534242u;
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

static void bytes_try(const uint8_t *bytes, size_t count)
{
    uint8_t *exact = malloc(count ? count : 1); /* so that reading beyond the end is seen */
    must(exact);
    memcpy(exact, bytes, count);
    LLVMFuzzerTestOneInput(exact, count);
    free(exact);
}

int main(void)
{
    static const struct demonstration_message seeds[] = {
        {.kind = DEMONSTRATION_FRAME, .number = 7, .seconds = 0.016},
        {.kind = DEMONSTRATION_POINTER, .which = 1, .x = 12.5, .y = -3, .pressure = 0.5},
        {.kind = DEMONSTRATION_KEY, .text = "Left"},
        {.kind = DEMONSTRATION_SHOWN, .number = 7, .which = 1},
        {.kind = DEMONSTRATION_SAID, .text = "3\t4 \xc3\xa9 \xe2\x82\xac"},
        {.kind = DEMONSTRATION_FAILED, .text = "live:3: no"},
        {.kind = DEMONSTRATION_RELEASE, .text = "Left"},
        {.kind = DEMONSTRATION_SET, .which = 11, .value = -2.5},
        {.kind = DEMONSTRATION_CONTROL,
         .which = 3,
         .control = {"speed", "1/s", "", "how fast", 0, 4, 1, 2, CONTROL_CENTRED}},
        {.kind = DEMONSTRATION_CONTROL,
         .control = {"ink", "", "blue red", "", 0, 1, 1, 0, CONTROL_CHOICE}}};
    enum { TRIES = 200000, SEEDS = sizeof seeds / sizeof *seeds };
    uint8_t packet[DEMONSTRATION_PACKET_MAX + 20];
    for (int i = 0; i < SEEDS; i++) { /* each goes one way only */
        struct demonstration_message m;
        const size_t count = demonstration_message_write(&seeds[i], packet);
        const bool to_process = seeds[i].kind <= DEMONSTRATION_SET;
        must(demonstration_message_read(packet, count, to_process, &m));
        must(!demonstration_message_read(packet, count, !to_process, &m));
        for (size_t cut = 0; cut < count && !seeds[i].text[0]; cut++)
            must(!demonstration_message_read(packet, cut, to_process, &m));
    }
    for (int i = 0; i < TRIES; i++) {
        size_t count = demonstration_message_write(&seeds[chance() % SEEDS], packet);
        const bool random = i % 3 == 0;
        if (random)
            count = chance() % 60;
        for (size_t k = random ? 1 : count; k < count; k++)
            packet[k] = (uint8_t)chance();
        if (random)
            packet[0] = (uint8_t)(chance() % (DEMONSTRATION_KINDS + 2));
        for (uint32_t k = chance() % 4; k > 0 && count; k--)
            packet[chance() % count] = (uint8_t)chance();
        if (i % 11 == 0) {
            const size_t more = chance() % 20;
            for (size_t k = 0; k < more; k++)
                packet[count + k] = (uint8_t)chance();
            count += more;
        }
        bytes_try(packet, count);
    }
    return 0;
}
#endif
