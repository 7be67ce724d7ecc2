/* pages_pictures.c - the pages of the verbs that make pictures. */
#include "pages.h"

#include <filter.h>
#include <sheet.h>
#include <word.h>

#include <stdio.h>
#include <string.h>

static void preset_names(char *text, size_t room)
{
    text[0] = '\0';
    for (int i = 0; i < dyn_presets_count; i++) {
        size_t used = strlen(text);
        snprintf(text + used, room - used, "%s%s", i ? ", " : "", dyn_presets[i].name);
    }
}

#define FONTS                                                                                  \
    "A font is a file's name with its folder, a font file's name without ending among the "    \
    "installed ones (EBGaramond12-Italic), or a family (\"DejaVu Sans\"); `fc-list : family "  \
    "file` "                                                                                   \
    "shows them. A folder of edits of a font may stand in its place, or FONT+FOLDER "          \
    "(`lutetia help font`)."
#define FILTERS                                                                                \
    "A filter is one of the names above, each with :RADIUS if wanted (cone:2); "               \
    "gaussian:SIGMA,RADIUS; samples:RADIUS,S0,S1,.. and round:RADIUS,S0,S1,.. give it from "   \
    "the centre outwards; @FILE reads such words from a file."

const struct page pages_of_pictures[] = {
    {.verb = "studio",
     .usages = "[FILE.h5] [options]",
     .about =
         "Opens a window in which one paints by hand on wet paper that goes on flowing: with "
         "brushes, washes, drops, salt, cloths, masking fluid and type, with a pen or a mouse. "
         "Each stroke can be undone, also while the paint flows.\n"
         "FILE is a sheet that was saved, here or by a script, with its past; without one "
         "there "
         "is a new sheet. docs/studio.md teaches the window; F1 in it shows its keys.",
     .notes = "The window needs GTK 4.8 or later and OpenGL 3.2, which libgl1-mesa-dri has "
              "without a graphics card, too. `./run studio` installs what is missing.",
     .values = {{.option = "stock", .fill = paper_stock_names},
                {.option = "pigment", .fill = paper_pigment_names},
                {.option = "theme", .words = "light, dark"}},
     .examples = {{"lutetia studio", "a new sheet of cold pressed paper"},
                  {"lutetia studio marsh.h5", "a sheet that was saved"},
                  {"lutetia studio --paper 1024x768 --stock rough --pigment \"indian red\" "
                   "--pigment \"burnt umber\"",
                   "rough paper, two pigments"}},
     .see = "lutetia-run(1), lutetia-paint(1)"},
    {.verb = "paint",
     .usages = "\"Text\" [options]\n--image FILE [options]",
     .about =
         "Sets a line of type, or prints a gray picture, in ink on watercolour paper, and lets "
         "water and pigments move. Each fiber of the paper is a processor of the machine; one "
         "fiber is a pixel of the picture.\n"
         "The same command gives the same picture, to the bit, on every device. With --model "
         "thesis the paper is that of Small's thesis of 1990: inks of cyan, magenta and "
         "yellow. "
         "Options that say \"full\" or \"thesis\" belong to that model alone.",
     .notes =
         "Of water and pigments 1 is a unit for each fiber. A unit of a pigment hides most of "
         "the paper; half of it is a usual wash, 4 the most, and what is below 0 takes away. A "
         "fiber soaks up a part of a unit of water, and what is more flows: with --wet 0 "
         "letters keep their edges, 0.1 softens them, 0.3 lets them flow into each other, and "
         "from 0.6 on they are lost. Without gravity the sheet lies flat.\n" FONTS "\n" FILTERS,
     .values = {{.option = "model", .words = "full, thesis"},
                {.option = "stock", .fill = paper_stock_names},
                {.option = "pigment", .fill = paper_pigment_names, .suffix = "="},
                {.option = "view", .words = "color, water, wet"},
                {.option = "filter", .list = font_filter_names}},
     .examples =
         {{"lutetia paint \"Paris\" -o paris.png", "a word in ultramarine, to paris.png"},
          {"lutetia paint \"Paris\" --stock rough --pigment \"phthalo green=0.6\" --pigment "
           "\"burnt umber=0.3\" --gravity 0.6 -o drips.png",
           "two pigments that run down rough paper"},
          {"lutetia paint \"Seine\" --font EBGaramond12-Italic --pigment \"cerulean blue=0.8\" "
           "--wet 0.1 --paper 800x400 -o seine.png",
           "another font and blue, soft edges on damp paper"},
          {"lutetia paint \"Paris\" --deckle --paper 480x320 -o sheet.png",
           "a small handmade sheet with its edges"},
          {"lutetia paint \"Wet\" --model thesis --steps 100 -o thesis.png",
           "the paper of the thesis"}},
     .see = "lutetia-run(1), lutetia-type(1), lutetia-info(1), fc-list(1)"},
    {.verb = "type",
     .usages = "\"Text\" [options]",
     .about =
         "Sets a text in gray letters at any size, at any fraction of a pixel, at any angle "
         "and "
         "distortion, with any filter, and writes it as PNG, SVG or PDF, as the ending of "
         "--out "
         "says. Light is mixed as light. A line feed in the text begins a line: $'one\\ntwo' "
         "in bash.",
     .notes = FONTS "\n" FILTERS
                    "\nWith --corners the upper left, upper right, lower right and lower left "
                    "corners of the box around the text, turned and sheared, go to these "
                    "places.",
     .values = {{.option = "filter", .list = font_filter_names},
                {.option = "display", .words = "lcd, crt, print"},
                {.option = "warp", .words = "projective, bilinear"},
                {.option = "align", .words = "left, right, center, justify"}},
     .examples =
         {{"lutetia type \"Wet Fonts\" --font EBGaramond12-Italic --size 72.25 --rotate 8 "
           "-o type.png",
           "a line, turned by 8 degrees"},
          {"lutetia type $'Seine\\nParis' --size 37.3 --rotate 23.7 --align center -o gray.png",
           "two lines, at an odd size and angle"},
          {"lutetia type \"Ag&\" --compare -o compare.png",
           "beside FreeType and the exact coverage, enlarged"},
          {"lutetia type \"Ag\" --filter cone:2 -o soft.png", "with a wider filter"}},
     .see = "lutetia-set(1), lutetia-font(1), lutetia-paint(1), fc-list(1)"},
    {.verb = "set",
     .usages = "FILE [options]",
     .about =
         "Sets a text as pages: paragraphs divided into lines by their badness, words "
         "divided, columns, notes at the foot and in the margin, around and inside shapes. "
         "The ending of --out says the kind of file: .png, .svg or .pdf. FILE may be - for "
         "what is piped in.",
     .notes =
         "In the text a blank line ends a paragraph; # begins a heading, - or 1. an item of a "
         "list, > a quote, and * * * parts the text; `*slanted*` or "
         "`_slanted_` and `**bold**` words; [^a note at the foot]; [>a note in the margin]. A "
         "backslash at a "
         "line's end keeps it, and before a sign makes that a letter.\n"
         "In PDF a pixel is a point, 1/72 inch: A4 is --paper 595x842.\n" FONTS "\n" FILTERS,
     .values = {{.option = "align", .words = "left, right, center, justify"},
                {.option = "filter", .list = font_filter_names}},
     .examples =
         {{"lutetia set letter.txt --hyphenate --columns 2 -o letter.pdf",
           "two columns, as PDF"},
          {"lutetia set letter.txt --paper 595x842 --size 11 --margin 72 --all -o letter.pdf",
           "all pages, on A4"},
          {"echo 'A *short* page.' | lutetia set - -o page.png", "what is piped in"},
          {"lutetia set letter.txt --around 300,400,120,80 -o around.png",
           "text that leaves an ellipse free"}},
     .files = "/usr/share/doc/lutetia/examples/pages: texts to begin with",
     .see = "lutetia-type(1), lutetia-font(1), fc-list(1)"},
    {.verb = "read",
     .usages = "[FILE.md...] [options]",
     .about =
         "Opens Markdown in a window in which it is scrolled, searched and read at any width "
         "and size; with --out sets it as pages: CommonMark with GitHub's tables, tasks, "
         "struck words, links "
         "and notes, and formulas in TeX's notation. Several files are one document; without "
         "one "
         "it is Lutetia's manual. The ending "
         "of --out says the kind of file: .png, .svg or .pdf; a PDF has all pages, its text "
         "tagged, its headings as outline. FILE may be - for what is piped in.",
     .notes =
         "$x^2$ is a formula within a line; $$x^2$$, or a fence ```math, one on lines of its "
         "own. What it does not know is shown as it is written. [^name] calls a note, which "
         "[^name]: defines; notes of the class [^margin:name] stand in the margin that --notes "
         "makes. A table whose columns have no room beside each other is set row by row. "
         "Pictures alone in a paragraph are shown if they are PNG files in the document's "
         "folder or below it, others told by captions and names; fences that will live (```lua "
         "live, "
         "```c paris) are shown.\n"
         "In PDF a pixel is a point, 1/72 inch: A4 is --paper 595x842.\n"
         "The window needs GTK 4.8 or later; F10 in it opens its menu, which says its "
         "keys.\n" FONTS,
     .values = {{.option = "theme", .words = "light, dark"}},
     .examples =
         {{"lutetia read", "the manual, in a window"},
          {"lutetia read notes.md", "a window"},
          {"lutetia read notes.md -o notes.pdf", "one PDF of all pages"},
          {"lutetia read one.md two.md --paper 595x842 --columns 2 --size 11 -o both.pdf",
           "two files as one document on A4"},
          {"echo 'The *water* is $x^2$ deep.' | lutetia read - --plain -o page.png",
           "what is piped in"}},
     .files =
         "/usr/share/lutetia/manual: the manual\n~/.local/share/lutetia/manual.notes: what "
         "was left in it",
     .see = "lutetia-set(1), lutetia-type(1)"},
    {.verb = "font",
     .usages = "FILE [options]\nFILE --glyph G [options]\nFILE --edits DIR [--glyph G [--write "
               "LEVEL]] [options]\nFILE --proof WORD [options]\nFILE --waterfall AXIS "
               "[options]\nFILE --typeface PX [options]\nFILE --against FILE "
               "[options]\n--show-filter [--filter F] [-o FILE]",
     .about =
         "Draws a specimen of a font; or one glyph at each level of the font pipeline: its "
         "outline, the master, the rectangles that it is summed from, and its gray; or a "
         "filter.\n"
         "--proof shows a word by every filter at several sizes, with its contrast, the width "
         "of "
         "an edge, its error to what is covered, and from how far it is read (by a model, at "
         "96 "
         "pixels to the inch). --against shows two versions of a font: red is only in the "
         "first, blue only in the second.\n"
         "A master is the glyph in black and white, --em pixels large; it may be written, "
         "retouched "
         "in a paint program, and taken again.\n"
         "Edits are kept in a folder: --write puts a level of a glyph there, to be edited by "
         "any "
         "program. --edits of `lutetia type`, set, spring, paint, keys and voice draws with "
         "them, and so does whoever is given "
         "the "
         "folder as a font. What lies below an edited level is made from it; a file that is as "
         "it was written changes nothing, but a filter counts at once. With --axes a level is "
         "written for that setting of the axes.",
     .notes = FONTS
     "\n" FILTERS "\nThe folder's edits.txt lists the files. Outlines are SVG in font units, y "
     "downwards, of paths alone; or UFO's glif. Masters are black and white PNG; "
     "rectangles a text, x0 y0 x1 y1 in master pixels.",
     .values = {{.option = "filter", .list = font_filter_names},
                {.option = "display", .words = "lcd, crt, print"},
                {.option = "write",
                 .words = "outline, glif, master, rectangles, filter, gray"}},
     .examples =
         {{"lutetia font DejaVuSans -o specimen.png", "a specimen"},
          {"lutetia font DejaVuSans --glyph '&' -o levels.png", "one glyph at each level"},
          {"lutetia font EBGaramond12-Regular --glyph f_f_i --edits mine --write outline",
           "the ligature's outline, to be drawn anew in a program for SVG"},
          {"lutetia font DejaVuSans --edits mine --write filter --filter cone --sizes 0,14",
           "small type by another filter"},
          {"lutetia font --show-filter --filter gaussian-fast -o filter.png", "a filter"}},
     .see = "lutetia-type(1), lutetia-set(1), fc-list(1)"},
    {.verb = "stage",
     .usages = "NAME [options of lutetia spring]\nFILE.lua [options of lutetia "
               "spring]\n--print NAME\n--list",
     .about =
         "Short pieces for a stage of springs. Each is a script in Lua of one screen, which "
         "says "
         "in a comment with which word and options it begins, and leads the stage's controls "
         "by its function frame(time). All options of `lutetia spring` go with a piece: "
         "without --still, --video and --frames there is a window.",
     .notes =
         "A piece is a map: section MAPS of lutetia-scripts(7). Its line `-- stage: spring "
         "\"WORDS\" [OPTION VALUE]...` may have --preset, --set, --at, --turn, --column, "
         "--circle, --view, --size, --param, --seconds, --theme and --font, and names no file.",
     .examples = {{"lutetia stage --list", "what there is"},
                  {"lutetia stage breath", "in a window"},
                  {"lutetia stage --print breath >mine.lua", "the start of one's own"}},
     .see = "lutetia-spring(1), lutetia-scripts(7)"},
    {.verb = "spring",
     .usages = "\"word\" [options]\n--network FILE [options]\n--controls",
     .about =
         "A word whose letters hang on masses and springs: it falls, swings and breaks. "
         "Without "
         "--still, --video and --frames there is a window; with them no display is needed.\n"
         "In the window a mass or a letter is dragged with the mouse; Shift pins it, the right "
         "button cuts a spring. Tab shows sliders for everything that can be adjusted, ? shows "
         "the keys, V records a film, Esc ends.",
     .notes =
         "--controls lists the controls that --set changes, with their ranges and what they "
         "do. A --map is a script in Lua whose function message(m) gets each message of an "
         "instrument, or of a --song: section MAPS of lutetia-scripts(7). With --knobs no "
         "script is needed: in the panel of controls (Tab) click a slider with the right "
         "button, "
         "and turn a knob; Shift and a drag set its ends, Control 1 to 9 keeps a scene, which "
         "1 "
         "to 9 or a program change calls. By --osc controls are set from other programs "
         "(/control/NAME "
         "value, /along/NAME part, /scene n), and --osc-to sends them. Files of --network, "
         "--script, --knobs and --theme are text; the documents below have their "
         "lines.\n" FONTS,
     .values = {{.option = "preset", .fill = preset_names},
                {.option = "theme", .words = "light, dark"},
                {.option = "way", .words = "exact, egl, osmesa"},
                {.option = "pigment", .fill = paper_pigment_names},
                {.option = "filter", .list = font_filter_names}},
     .examples =
         {{"lutetia spring breakdown --preset breakdown", "in a window"},
          {"lutetia spring breakdown --preset breakdown --set collide=on --still "
           "breakdown.png --strip 2x4 --seconds 2 --size 1200x1000 --view -1,-0.4,7.2,3.05",
           "eight moments in one picture, without a display"},
          {"lutetia spring chord --preset heavy --map "
           "/usr/share/doc/lutetia/examples/maps/chord.lua --song "
           "/usr/share/doc/lutetia/examples/scripts/played.mid --video chord.mp4",
           "a song plays the word, in a film"},
          {"lutetia spring --controls", "what can be adjusted"}},
     .files =
         "/usr/share/doc/lutetia/examples/maps: maps to begin with\n"
         "/usr/share/doc/lutetia/examples/scripts/played.mid: a song to begin with\n"
         "/usr/share/doc/lutetia/examples/springs: files of --network (.springs) and of "
         "--script (.clamps)\n"
         "/usr/share/doc/lutetia/springs.md: what masses, springs and controls do, and the "
         "lines of these files\n"
         "/usr/share/doc/lutetia/stage.md: the window, and the lines of a --theme",
     .see = "lutetia-keys(1), lutetia-midi(1), lutetia-run(1), lutetia-scripts(7)"},
    {.verb = "voice",
     .usages = "SOUND \"Text\" [options]\nSOUND --transcript FILE [options]\n--cry \"Text\" "
               "[options]\n--microphone any \"Text\" "
               "[options]",
     .about =
         "A voice sets the size, place and colour of letters. SOUND is a file (WAV, FLAC, "
         "...). "
         "With none of --poster, --sheet, --envelope, --still, --frames and --video the "
         "poster is "
         "written, to out.png; with a microphone there is a window instead.\n"
         "A text of one word is played as it is. Of several words each is shown while it is "
         "said: they are found in the voice by their letters, whatever the language, or by "
         "the times of --transcript.",
     .notes =
         "--map ties properties of letters to features of the voice: size, weight, slant, "
         "baseline and ink to envelope, level, pitch, clarity, open, front (a vowel's two "
         "formants), vowel (ink only) or nothing, as in size=envelope,baseline=pitch.\n"
         "Level and envelope are how loud it is, of full scale and of the loudest; pitch goes "
         "from the lowest to the highest in the sound; clarity is 0 of noise and 1 of a clear "
         "tone; open is how far the mouth is open, as of a, and front how far the tongue is in "
         "front, as of i.\n" FONTS,
     .values = {{.option = "microphone", .words = "jack, pulse, any"}},
     .examples = {{"lutetia voice --cry \"Aagh\" --map baseline=pitch,ink=open -o cry.png",
                   "a cry of the program's own making"},
                  {"lutetia voice speech.wav \"To be or not\" --video speech.mp4",
                   "a film with the voice as its sound (needs ffmpeg)"},
                  {"lutetia voice --microphone any \"Aagh\"", "what a microphone hears"}},
     .see = "lutetia-keys(1), lutetia-type(1)"},
    {.verb = "keys",
     .usages = "[options]\nSONG.mid [options]",
     .about =
         "A key is a letter: its velocity and aftertouch are how large it is, its release how "
         "it "
         "goes. With SONG.mid, a Standard MIDI File, a poster is written to out.png unless "
         "other "
         "pictures are asked for; `lutetia midi record` makes such a file of what is played.\n"
         "Without a song there is a window, where what the MIDI server hears plays (`lutetia "
         "midi "
         "serve`); where there is no server the computer's own keyboard plays.",
     .notes =
         "A --map that ends in .lua is a script that turns any message into any control: "
         "section "
         "MAPS of lutetia-scripts(7). What it does is seen in a window and by --still, "
         "--frames "
         "and --video. Another one has a line for each key, as 'c4 A'.\n"
         "The controls of --set and of maps are size, attack, release, pressure, slant, and "
         "weight and width of a font that has these axes; with --wet gravity, tilt, humidity, "
         "edge, pace (steps a second), size, height, water, ink, pigment, and brush_x, "
         "brush_y, "
         "brush_size, brush_water and brush_ink of a brush that a map leads.\n" FONTS,
     .values = {{.option = "stock", .fill = paper_stock_names},
                {.option = "pigment", .fill = paper_pigment_names},
                {.option = "theme", .words = "light, dark"}},
     .examples = {{"lutetia keys song.mid -o poster.png", "each note as a letter, along lines"},
                  {"lutetia keys song.mid --wet --still wet.png --at 4",
                   "printed on wet paper, after four seconds"},
                  {"lutetia keys song.mid --video song.mp4", "a film with its sound"},
                  {"lutetia keys --text \"page\" --range c3-c5", "a window that is played"}},
     .files = "/usr/share/doc/lutetia/examples/scripts/played.mid: a song to begin with\n"
              "/usr/share/doc/lutetia/examples/maps: maps to begin with",
     .see = "lutetia-midi(1), lutetia-voice(1), lutetia-spring(1), lutetia-scripts(7)"},
    {.verb = "run",
     .usages = "SCRIPT.lua [key=value...] [options]",
     .about = "Runs a script in Lua that makes papers, inks, masks, brushes, springs and time. "
              "lutetia-scripts(7) describes the language. key=value are the script's own "
              "parameters.\n"
              "Scripts run in a sandbox: they read pictures in --in, write pictures and saved "
              "papers in "
              "--out, and reach nothing else. The same script with the same seed gives the "
              "same bits.",
     .notes =
         "A --sweep is KEY=a,b,c, or 1..5 for whole numbers, or 0..1/5 for five numbers from 0 "
         "to 1; several of them, separated by semicolons, give all combinations. Each run "
         "writes into a folder of its own, KEY-value.\n"
         "Ctrl-C stops a run. Its papers are saved then, too: to the file of --save, or "
         "without "
         "it to SCRIPT-interrupted.h5 in --out, which a line names; a run of a sweep keeps "
         "nothing. --resume continues them.",
     .examples = {{"lutetia run rain.lua word=Paris -o pictures", "a script with a parameter"},
                  {"lutetia run rain.lua --sweep \"word=Wet,Dry\" -j 2 -o both",
                   "two runs at a time"},
                  {"lutetia run rain.lua --video rain.mp4", "a film of the first paper"}},
     .files = "/usr/share/doc/lutetia/examples/scripts: scripts to begin with\n"
              "/usr/share/doc/lutetia/recipes.md: ten effects, each with its script",
     .see = "lutetia-scripts(7), lutetia-paint(1)"},
    {.verb = "demo",
     .usages = "[options]",
     .about = "Paints the demonstration page and writes three pictures: page.png, the page; "
              "stages.png, how it was painted; water.png, the water on it.",
     .examples = {{"lutetia demo -o pictures", "into the folder pictures, which is made"}},
     .see = "lutetia-paint(1), lutetia-run(1)"},
    {0}};
