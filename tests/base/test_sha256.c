/* test_sha256.c - SHA-256 and HMAC beside published values (FIPS 180-4, RFC 4231), and beside
 * Python's in test_challenge.py. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <sha256.h>

static void check(const uint8_t digest[static SHA256_BYTES], const char *hex)
{
    char text[2 * SHA256_BYTES + 1];
    for (int i = 0; i < SHA256_BYTES; i++)
        snprintf(text + 2 * i, 3, "%02x", digest[i]);
    assert_string_equal(text, hex);
}

static void sums_are_the_published_ones(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int times;
        const char *hex;
    } rows[] = {
        {"", 1, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
        {"abc", 1, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
        {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 1,
         "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
        {"a", 1000000, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sha256 sum;
        uint8_t digest[SHA256_BYTES];
        sha256_begin(&sum);
        for (int k = 0; k < rows[i].times; k++)
            sha256_add(&sum, rows[i].text, strlen(rows[i].text));
        sha256_end(&sum, digest);
        check(digest, rows[i].hex);
    }
}

static void pieces_make_no_difference(void **state)
{
    (void)state;
    uint8_t bytes[300], whole[SHA256_BYTES], parts[SHA256_BYTES];
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (uint8_t)(i * 7);
    for (size_t count = 0; count < sizeof bytes; count++) {
        struct sha256 sum;
        sha256_begin(&sum);
        sha256_add(&sum, bytes, count);
        sha256_end(&sum, whole);
        sha256_begin(&sum);
        for (size_t i = 0; i < count; i++)
            sha256_add(&sum, bytes + i, 1);
        sha256_end(&sum, parts);
        assert_memory_equal(whole, parts, SHA256_BYTES);
    }
}

static void codes_are_the_published_ones(void **state)
{
    (void)state;
    uint8_t code[SHA256_BYTES], key[131], data[50];
    memset(key, 0x0b, 20);
    sha256_hmac(key, 20, "Hi There", 8, code);
    check(code, "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
    sha256_hmac("Jefe", 4, "what do ya want for nothing?", 28, code);
    check(code, "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
    memset(key, 0xaa, sizeof key);
    memset(data, 0xdd, sizeof data);
    sha256_hmac(key, 20, data, sizeof data, code);
    check(code, "773ea91e36800e46854db8ebd09181a72959098b3ef8c122d9635514ced565fe");
    /* a key that is longer than a block */
    const char *text = "Test Using Larger Than Block-Size Key - Hash Key First";
    sha256_hmac(key, sizeof key, text, strlen(text), code);
    check(code, "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_the_published_ones),
        cmocka_unit_test(pieces_make_no_difference),
        cmocka_unit_test(codes_are_the_published_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
