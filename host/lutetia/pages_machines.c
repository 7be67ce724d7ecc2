/* pages_machines.c - the pages of the verbs about programs in C/Paris, instruments and the
 * machine; and which page is whose. */
#include "pages.h"

#include <assert.h>
#include <string.h>

const struct page pages_of_machines[] = {
    {.verb = "",
     .usages = "VERB ...\nVERB --help\n--help\n--version",
     .about =
         "Lutetia is a Connection Machine in software, for any OpenCL device, and what is made "
         "with "
         "it: watercolour, springy letters, and letters that a keyboard or a voice plays. The "
         "command has a verb for each of these; each has a page of its own.\n"
         "Programs in C/Paris of 1990 are compiled by `lutetia cc` and run unchanged; paris(7) "
         "describes the instructions. Papers, inks and time can be scripted in Lua; "
         "lutetia-scripts(7) describes the language.\n"
         "Options are --name value, --name=value or -o value; -- ends them. The first use of a "
         "kind "
         "of picture compiles kernels for the device, and keeps them for later.",
     .examples = {{"lutetia demo -o pictures", "paints the demonstration page"},
                  {"lutetia paint \"Paris\" -o paris.png", "a word in ink on wet paper"},
                  {"lutetia cc heat.c -o heat && ./heat",
                   "compiles and runs a C/Paris program"},
                  {"lutetia midi render song.mid -o song.wav", "plays a song to a file"},
                  {"LUTETIA_DEVICE=1 lutetia info", "chooses another OpenCL device"}},
     .files = "$XDG_CACHE_HOME/lutetia: compiled kernels, and what `lutetia tune` kept; "
              "~/.cache/lutetia without that variable. It may be deleted at any time\n"
              "$XDG_CACHE_HOME/pocl/kcache: kernels that PoCL compiled, likewise\n"
              "$XDG_RUNTIME_DIR/lutetia-midi: the socket of the MIDI server",
     .see = "paris(7), lutetia-scripts(7), clinfo(1)"},
    {.verb = "cc",
     .usages = "prog.c... [-o prog] [options of the C compiler]",
     .about =
         "Compiles C/Paris programs and links them with libparis. It calls the C compiler with "
         "the folders of <cm/paris.h> and of the library, and passes all other arguments on.\n"
         "C is taken as it was in 1990, -std=gnu89, unless a -std is given; functions without "
         "declaration are warned of. -g1 is given unless another -g is, so that complaints "
         "name "
         "lines of the source. Where the compiler fails, a program of that name that was there "
         "before is left.\n"
         "If a source is C++ (prog.cc, .cpp, .cxx, .C), the C++ compiler is called.",
     .notes =
         "`cc prog.c $(pkg-config --cflags --libs paris)` does the same, where libparis is "
         "installed with its header (on Debian the package libparis-dev).",
     .examples = {{"lutetia cc heat.c -o heat", "compiles the example of paris(7)"},
                  {"lutetia cc -std=c17 -O2 -Wall prog.c -o prog",
                   "with options of the compiler"}},
     .files = "/usr/share/doc/libparis-dev/examples: programs to begin with, life.c and others",
     .see = "paris(7), lutetia-explain(1), lutetia-leds(1)"},
    {.verb = "leds",
     .usages = "[options] prog [arguments]\n[options] recording\n[options] --pattern random",
     .about = "Runs a C/Paris program and shows the machine's lights as CM_latch_leds sets "
              "them, in a "
              "window or in PNG pictures. Where there is no display it writes leds.png. A "
              "recording is "
              "a file that LUTETIA_LEDS=FILE left; - is the standard input.\n"
              "Closing the window, or Esc in it, stops the program. A recording stops and goes "
              "on with "
              "Space, steps with a full stop, slows with - and quickens with =.",
     .notes =
         "LUTETIA_LEDS=window ./prog shows the lights, too; LUTETIA_LEDS=FILE ./prog leaves a "
         "recording.",
     .values = {{.option = "view", .words = "cube, front, door"},
                {.option = "pattern", .words = "random, noise, on"}},
     .examples = {{"lutetia leds ./life", "a program's lights"},
                  {"lutetia leds --pattern random -o leds.png --count 1",
                   "the machine's own pattern"}},
     .see = "lutetia-cc(1), CM_latch_leds(3), paris(7)"},
    {.verb = "display",
     .usages = "[options] prog [arguments]\n[options] recording",
     .about =
         "Runs a C/Paris program and shows what it writes to the displays of the frame "
         "buffer (<cm/cmfb.h>), each in a window, or in PNG pictures, or as a film. Where "
         "there can be no window it writes display.png, the last picture. A recording is a "
         "file that LUTETIA_DISPLAY=FILE left; - is the standard input.\n"
         "Closing a window, or Esc in it, stops the program. A recording stops and goes on "
         "with Space, steps with a full stop, slows with - and quickens with =.",
     .notes =
         "Each change of what is seen is a picture: a write to the buffer that is seen, "
         "another buffer, zoom, pan, another colour map. The window shows the newest, and "
         "the program does not wait for it; pictures and films have all of them, and the "
         "program waits until each is written.\n"
         "LUTETIA_DISPLAY=window ./prog shows the displays, too; LUTETIA_DISPLAY=FILE ./prog "
         "leaves a recording, whose pictures are not compressed.",
     .examples = {{"lutetia display ./heat", "a program's display in a window"},
                  {"lutetia display --film heat.mp4 ./heat", "all its pictures as a film"},
                  {"lutetia display -o last.png ./heat", "the last picture"}},
     .files = "/usr/share/doc/lutetia/frame-buffer.md: the calls, and where they come from",
     .see = "lutetia-cc(1), lutetia-leds(1), paris(7)"},
    {.verb = "explain",
     .usages = "[options] prog [arguments]\n[options] prog.c [arguments]",
     .about = "Runs a C/Paris program, and says what its machine recorded, what vanished and "
              "why, where "
              "it was cut and why, and what each kernel took beside what it could have. A file "
              "that ends "
              "in .c is compiled first, as by `lutetia cc`.",
     .notes =
         "An instruction is recorded, not executed: it makes a value, the content of a field "
         "or "
         "a flag. A value is computed when somebody looks at it, or when much is waiting; one "
         "that is overwritten first has vanished. Calls that came before in the same order are "
         "foreseen, and not recorded again.\n"
         "What is computed at once is a plan. It is cut into kernels, programs that the device "
         "runs, or interpreted where it is small. A value is put into memory if it was looked "
         "at, if a field or flag keeps it, if neighbours read it, or if a later kernel does; "
         "within a kernel it costs no memory.\n"
         "Any program does the same without the verb: LUTETIA_EXPLAIN=/dev/stderr ./prog.",
     .examples = {{"lutetia explain ./heat", "a program that was compiled"},
                  {"lutetia explain --json heat.json heat.c",
                   "the same as JSON, from its source"}},
     .files = "/usr/share/doc/lutetia/engine-reference.md: each line of the report, explained",
     .see = "lutetia-cc(1), lutetia-tune(1), paris(7)"},
    {.verb = "debug",
     .usages = "[options] prog [arguments]",
     .about =
         "Runs a C/Paris program in gdb, with commands of its own that show fields. A field is "
         "named by the variable that holds its id, or by a number; compile the program by "
         "`lutetia cc -g`, so that gdb knows its variables. TYPE is u, s or f, with lengths as "
         "in `u 16` and `f 23 8`; without it floats are shown as they were stored, and other "
         "bits as numbers without sign.\n"
         "gdb stops where the library complains of a call, before the program ends. What is "
         "shown of fields is computed in a process of its own, so the program computes what "
         "it would have computed.",
     .notes =
         "field F [TYPE]: a field's values as a table, and statistics of them\n"
         "field F [TYPE] at 3 5: one processor's; table, statistics, histogram, picture or "
         "picture "
         "FILE.png in place of `at`: these\n"
         "diff F G [TYPE]: where two fields differ\n"
         "context: which processors are active, as a picture\n"
         "where: the Paris call, what waits to be computed, the calls of the program\n"
         "watch-field F [TYPE] at 3 5: stop after the call that changes the value\n"
         "watch-field F [TYPE] nan: stop after the call that makes a NaN; unwatch-field N ends "
         "a "
         "watch\n"
         "All other commands are gdb's: `break 20`, `run`, `next`, `print x`, `continue`, "
         "`quit`; `help field` says more of ours. In the midst of a Paris call fields cannot "
         "be shown: `finish` goes to its end.\n"
         "While a field is watched the program computes after each call: more slowly, with the "
         "same bits.",
     .examples = {{"lutetia cc -g heat.c -o heat && lutetia debug heat",
                   "a program, with its variables"},
                  {"lutetia debug --batch -e run -e where heat",
                   "where it is stopped, without a question"}},
     .files = "/usr/share/doc/lutetia/debugging.md: a session with five faults",
     .see = "lutetia-cc(1), lutetia-explain(1), paris(7), gdb(1)"},
    {.verb = "midi",
     .usages = "serve [NAME=]KIND[:ARGUMENT]... [options]\nVERB ...",
     .about =
         "`lutetia midi serve` is a process that opens instruments; any number of programs "
         "play "
         "them and listen to them through it. The other verbs are such programs. Where no "
         "server "
         "runs they say so.\n"
         "Devices are written [NAME=]KIND[:ARGUMENT], where NAME is what programs call one, as "
         "in "
         "keys=raw:/dev/snd/midiC1D0; `lutetia midi devices kinds` lists the kinds. The kind "
         "sound is "
         "a synthesizer that is heard; where the computer has no sound, sound:FILE.wav writes "
         "what "
         "would be heard.\n"
         "A song is heard without a server, too: `lutetia midi render` writes it as a WAV "
         "file.",
     .notes =
         "Filters are words, applied from left to right: drop=NAMES, keep=NAMES, "
         "channels=1-4,10, "
         "notes=c2-c6, transpose=-12, velocity=0.6, channel=3, split=c4:2, thin=20.\n"
         "A message in words is its name, the channel from 1, then numbers; a note is a number "
         "or a "
         "name such as c4 (60): 'note-on 10 c#2 90', 'control 1 7 127', 'bend 1 -200', 'sysex "
         "f0 7e "
         "7f 09 01 f7'.\n"
         "The server runs for a user at each login where the user's systemd starts it: "
         "`systemctl "
         "--user enable --now lutetia-midi`. Its devices are in ~/.config/lutetia-midi.conf.",
     .examples = {{"lutetia midi serve speakers=sound &",
                   "a server whose one device is the loudspeakers"},
                  {"lutetia midi play song.mid -d speakers", "plays a song there"},
                  {"lutetia midi render song.mid -o song.wav",
                   "the same as a file, without a server"},
                  {"lutetia midi serve keys=raw:/dev/snd/midiC1D0 through=loop",
                   "an instrument, and a loop"},
                  {"lutetia midi monitor", "what arrives, in words"},
                  {"lutetia midi record song.mid",
                   "what arrives, as a Standard MIDI File, until Ctrl-C"},
                  {"lutetia midi send 'note-on 1 c4 100' -t 1 -d keys",
                   "one note, for a second"}},
     .files =
         "/usr/share/doc/lutetia/examples/scripts/played.mid: a song to begin with\n"
         "$XDG_RUNTIME_DIR/lutetia-midi: the server's socket; without XDG_RUNTIME_DIR "
         "/tmp/lutetia-UID/lutetia-midi\n"
         "~/.config/lutetia-midi.conf: DEVICES=\"keys=raw:/dev/snd/midiC1D0\", what the user "
         "unit's server opens (through=loop)",
     .see = "lutetia-keys(1), lutetia-spring(1)"},
    {.verb = "bench",
     .usages = "NAME [options]",
     .about = "Measures, beside the peers that are installed and the memory's bandwidth, in "
              "one run. "
              "`lutetia bench NAME --help` lists a benchmark's own options.",
     .notes = "Most benchmarks take --sizes N,WxH,..., --repeat N (counted runs of each), "
              "--json FILE "
              "(the rows, as one object) and --plot FILE (the rows drawn, PNG).",
     .examples = {{"lutetia bench diffusion --sizes 512",
                   "the watercolour step on 512x512 fibers"},
                  {"lutetia bench scan --json scan.json --plot scan.png", "rows to files"}},
     .see = "lutetia-tune(1), lutetia-info(1)"},
    {.verb = "tune",
     .usages = "[options]",
     .about =
         "Measures, in less than a minute, how generated code runs fastest on the device that "
         "LUTETIA_DEVICE chooses, and keeps that for all programs to come. Results are the "
         "same "
         "bits with and without.",
     .examples = {{"lutetia tune", "measures and keeps"},
                  {"lutetia tune --dry-run --json tried.json", "keeps nothing but a report"}},
     .files = "$XDG_CACHE_HOME/lutetia: what is kept, one file a device",
     .see = "lutetia-info(1), lutetia-bench(1)"},
    {.verb = "info",
     .usages = "[options]",
     .about =
         "Prints the version, the OpenCL devices and which is chosen, the folder of compiled "
         "kernels, what `lutetia tune` kept, and the bits that a fiber of paper takes.",
     .examples = {{"lutetia info", "all of it"},
                  {"lutetia info --variables", "the variables of the environment"}},
     .see = "lutetia-tune(1), lutetia(1)"},
    {0}};

const struct page *page_of(const char *verb)
{
    static const struct page *const all[] = {pages_of_pictures, pages_of_machines};
    const struct page *found = NULL;
    for (size_t i = 0; i < sizeof all / sizeof *all && !found; i++)
        for (const struct page *page = all[i]; page->verb && !found; page++)
            if (strcmp(page->verb, verb) == 0)
                found = page;
    assert(found);
    return found;
}
