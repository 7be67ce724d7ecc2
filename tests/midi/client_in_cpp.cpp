// client_in_cpp.cpp - the client library's headers, in C++; linked, too.
#include <midi_client.h>
#include <midi_encoder.h>
#include <midi_notes.h>
#include <midi_song.h>

int main()
{
    midi_client_def def = midi_client_def_default("c++");
    midi_client *client;
    midi_encoder encoder = {};
    uint8_t bytes[MIDI_ENCODED_MAX];
    const midi_message message = midi_message_make(0, MIDI_NOTE_ON, 60, 100);
    def.address = "/nowhere/socket";
    return midi_encoder_put(&encoder, &message, bytes) == 3 &&
                   midi_client_open(&def, &client) != MIDI_OK
               ? 0
               : 1;
}
