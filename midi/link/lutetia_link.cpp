/* lutetia_link.cpp - a peer of Ableton Link whose beat is a MIDI clock.
 *
 *     lutetia-link [TEMPO]       quarter notes a minute of a session that has no other peer, 120
 *
 * It writes bytes of MIDI to its output: start (fa) and a clock (f8) at a quarter note, then 24
 * clocks in each. Where the session's beat jumps, because two sessions have become one, or
 * because somebody has moved it, it begins again at the next quarter note. It ends when nobody
 * reads.
 *
 * It is a program of its own because Link is C++ and under the GNU General Public License,
 * version 2 or later: so is this program where it is built, and nothing else of Lutetia.
 */
#include <ableton/Link.hpp>

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace
{

constexpr double kQuantum = 4; /* quarter notes of a bar, to which peers align */
constexpr std::int64_t kClocks = 24, kNear = 6; /* a jump is more than a sixteenth note */
constexpr auto kLook = std::chrono::milliseconds(20);

/* False: nobody reads. */
bool put(bool starts)
{
    static const unsigned char bytes[] = {0xfa, 0xf8};
    return write(STDOUT_FILENO, starts ? bytes : bytes + 1, starts ? 2 : 1) > 0;
}

/* Waits for the clock `due` of the session, but not for long: the session may change. False: it
 * is not time yet. */
bool wait_for(const ableton::Link &link, std::int64_t due)
{
    const auto state = link.captureAppSessionState();
    const double beat = static_cast<double>(due) / static_cast<double>(kClocks);
    const auto left = state.timeAtBeat(beat, kQuantum) - link.clock().micros();
    std::this_thread::sleep_for(left < kLook ? left : kLook);
    return left < kLook;
}

void play(ableton::Link &link)
{
    std::int64_t last = 0;
    bool runs = false;
    for (;;) {
        const double beat =
            link.captureAppSessionState().beatAtTime(link.clock().micros(), kQuantum);
        const auto passed = static_cast<std::int64_t>(std::floor(beat * kClocks));
        runs = runs && std::abs(passed - last) <= kNear;
        const std::int64_t due =
            runs ? last + 1 : kClocks * (static_cast<std::int64_t>(std::floor(beat)) + 1);
        if (due > passed && !wait_for(link, due))
            continue;
        if (!put(!runs))
            return;
        last = due;
        runs = true;
    }
}

} // namespace

int main(int argc, char **argv)
{
    char *end = nullptr;
    const double tempo = argc > 1 ? std::strtod(argv[1], &end) : 120;
    if (argc > 2 || (end && *end) || !(tempo >= 20 && tempo <= 999)) {
        std::fprintf(stderr, "usage: lutetia-link [TEMPO], 20..999 quarter notes a minute\n");
        return 2;
    }
    std::signal(SIGPIPE, SIG_IGN);
    ableton::Link link(tempo);
    link.enable(true);
    play(link);
    return 0;
}
