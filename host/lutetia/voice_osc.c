/* voice_osc.c - see voice_osc.h. */
#include "voice_osc.h"

#include "lutetia.h"

#include <osc.h>

#include <stdlib.h>

int voice_osc_open(const char *to, struct osc_port **out)
{
    const struct osc_port_def def = {.send = to};
    return osc_port_open(&def, out) == STAGE_OK ? EXIT_SUCCESS
                                                : fail("voice", "--osc-to: %s", stage_error());
}

void voice_osc_send(struct osc_port *port, const struct voice_frame *f)
{
    uint8_t packet[400];
    size_t used = 0;
    const struct {
        const char *address;
        double value;
    } rows[] = {{"/voice/level", f->level},
                {"/voice/envelope", f->envelope},
                {"/voice/pitch", f->pitch_hz},
                {"/voice/clarity", f->clarity},
                {"/voice/bright", f->bright}};
    if (f->attack)
        used = osc_bundle_add(packet, sizeof packet, used, "/voice/attack", "f", f->level);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        used = osc_bundle_add(packet, sizeof packet, used, rows[i].address, "f", rows[i].value);
    used = osc_bundle_add(packet, sizeof packet, used, "/voice/formants", "ff",
                          f->formant_hz[0], f->formant_hz[1]);
    osc_port_send(port, packet, used);
}
