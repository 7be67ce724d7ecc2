/* midi_octave.c - also plays every key an octave higher. Ends with the server.
 *
 *     lutetia midi serve keys=raw:/dev/snd/midiC1D0 &
 *     cc midi_octave.c $(pkg-config --cflags --libs lutetia-midi) -o midi_octave && ./midi_octave keys keys */
#include <midi_client.h>

#include <stdio.h>

int main(int argc, char **argv)
{
    struct midi_client_def def = midi_client_def_default("octave");
    struct midi_client *client;
    struct midi_client_event event = {.kind = MIDI_CLIENT_NOTHING};
    def.address = argc > 3 ? argv[3] : NULL;
    def.stays = false;
    if (argc < 3) {
        fprintf(stderr, "usage: midi_octave FROM TO [SERVER]\n");
        return 2;
    }
    if (midi_client_open(&def, &client) != MIDI_OK ||
        midi_client_listen(client, argv[1], "keep=notes transpose=12") != MIDI_OK) {
        fprintf(stderr, "midi_octave: %s\n", midi_error());
        return 1;
    }
    const int to = midi_client_device(client, argv[2]);
    while (midi_client_next(client, -1, &event) == MIDI_OK)
        if (event.kind == MIDI_CLIENT_MESSAGE &&
            midi_client_send(client, to, &event.message) != MIDI_OK)
            break;
    fprintf(stderr, "midi_octave: %s\n", midi_error());
    midi_client_close(client);
    return 0;
}
