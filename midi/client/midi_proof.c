/* midi_proof.c - see midi_proof.h. */
#include "midi_proof.h"

#include <stdio.h>
#include <string.h>
#include <sys/random.h>

static void digits_put(const uint8_t bytes[static SHA256_BYTES],
                       char digits[static MIDI_PROOF_DIGITS + 1])
{
    for (int i = 0; i < SHA256_BYTES; i++)
        snprintf(digits + 2 * i, 3, "%02x", bytes[i]);
}

bool midi_proof_nonce(char nonce[static MIDI_PROOF_DIGITS + 1])
{
    uint8_t bytes[SHA256_BYTES];
    if (getrandom(bytes, sizeof bytes, 0) != (ssize_t)sizeof bytes)
        return false;
    digits_put(bytes, nonce);
    return true;
}

void midi_proof_begin(struct midi_proof *proof, int port, const char *hello,
                      const char *challenge)
{
    struct sha256 sum;
    char line[16];
    snprintf(line, sizeof line, "%d\n", port);
    sha256_begin(&sum);
    sha256_add(&sum, line, strlen(line));
    sha256_add(&sum, hello, strlen(hello));
    sha256_add(&sum, "\n", 1);
    sha256_add(&sum, challenge, strlen(challenge));
    sha256_end(&sum, proof->said);
}

void midi_proof_code(const struct midi_proof *proof, const char *token, const char *side,
                     char code[static MIDI_PROOF_DIGITS + 1])
{
    uint8_t bytes[16 + SHA256_BYTES], digest[SHA256_BYTES];
    const size_t length = strlen(side);
    memcpy(bytes, side, length);
    bytes[length] = '\n';
    memcpy(bytes + length + 1, proof->said, SHA256_BYTES);
    sha256_hmac(token, strlen(token), bytes, length + 1 + SHA256_BYTES, digest);
    digits_put(digest, code);
}

bool midi_proof_right(const struct midi_proof *proof, const char *token, const char *side,
                      const char *said)
{
    char code[MIDI_PROOF_DIGITS + 1];
    unsigned int differs = 0;
    midi_proof_code(proof, token, side, code);
    if (!token[0] || strlen(said) != MIDI_PROOF_DIGITS)
        return false;
    for (int i = 0; i < MIDI_PROOF_DIGITS; i++)
        differs |= (unsigned int)(code[i] ^ said[i]);
    return !differs;
}
