/* The verbs: the operands and options of each, and its help. Texts are wrapped when they are
 * printed; lines that begin with a space are not wrapped. One file, because it is one list, from
 * which the help, the manual page and completions are printed: most of its lines are texts. */
#include "program/options/verbs.h"

#include <string.h>

/* ---------------------------------------------------------------- options of several verbs */

static const cs_option shared[] = {
    {"--frames", "LIST", &cs_argument_frames,
     "the frames, such as 1-10,20-30:2,45; of a film also 2s-4s, or names of its marks; default: "
     "all"},
    {"--size", "WxH", &cs_argument_size,
     "pixels of the whole frame; each axis is scaled separately"},
    {"--fit", "HOW", &cs_argument_fit,
     "where --size has another shape than the film: stretch, contain (with clear bars) or cover"},
    {"--crop", "X,Y,W,H", &cs_argument_crop, "the part to render, in pixels of the output"},
    {"--antialias", "MODE", &cs_argument_antialias,
     "area (the average over each pixel), none (pixel centres), or KERNEL[:ROWS]: box, gaussian, "
     "mitchell or lanczos; ROWS: the parts into which a row of pixels is cut, 16; default: each "
     "rostrum's own"},
    {"--format", "NAME", &cs_argument_format, "the file format; default: by the extension of OUT"},
    {"--depth", "DEPTH", &cs_argument_depth, "8, 16, half or float; default: by the format"},
    {"--colour", "CODING", &cs_argument_colour,
     "srgb, linear, rec709, cineon, or a space of --ocio; default: srgb, floats linear"},
    {"--display", "NAME", &cs_argument_text,
     "instead of --colour: as this display of --ocio shows the light"},
    {"--view", "NAME", &cs_argument_text,
     "in this view of the display; default: the configuration's"},
    {"--ocio", "FILE", &cs_argument_file,
     "the OpenColorIO configuration; default: the environment variable OCIO"},
    {"--alpha", "KIND", &cs_argument_alpha,
     "straight or premultiplied; default: straight, floats premultiplied"},
    {"--dither", NULL, NULL,
     "8 bits without banding: rounded up or down by the position of the pixel; the default of "
     "videos"},
    {"--no-dither", NULL, NULL, "8 bits rounded to nearest; the default except of videos"},
    {"--flat", "HOW", &cs_argument_flat,
     "of a drawing: over (areas continue under each other, so that no seams show; default) or "
     "regions (areas that do not overlap)"},
    {"--precision", "N", &cs_argument_precision,
     "of an SVG drawing: digits after the point, 0 to 9; default: 3"},
    {"--quality", "Q", &cs_argument_quality,
     "of a video: 0 (small) to 100 (hardly any loss); default: 75"},
    {"--codec", "NAME", &cs_argument_codec,
     "of a video: h264, h265, av1, vp9, prores, prores422, prores422hq, dnxhr, ffv1"},
    {"--max-size", "BYTES", &cs_argument_millions,
     "of a video: the highest quality that fits into so many bytes, such as 8M"},
    {"--crf", "N", &cs_argument_crf,
     "the constant rate factor of h264, h265, av1, vp9 or avif, instead of --quality"},
    {"--loudness", "LUFS", &cs_argument_loudness,
     "the loudness of the whole sound by EBU R 128, such as -14; default: as it is mixed"},
    {"--loop", "N", &cs_argument_plays,
     "how often a .gif, .webp, .apng or .avif is played; default: 0, for ever"},
    {"--fps", "N", &cs_argument_rate,
     "of a video: another rate of frames; the length is the film's, and pictures are held or left "
     "out"},
    {"--background", "RGB", &cs_argument_tint,
     "a back light of this colour, with matte 1, behind everything"},
    {"--cel", "NAME", &cs_argument_cel,
     "only the cels with this name (cel:named), with their lights"},
    {"--layers", "WHAT", &cs_argument_layers,
     "cels: an OpenEXR, OpenRaster or Photoshop file also has each cel alone; of PNG, a file a "
     "cel"},
    {"--cryptomatte", "BY", &cs_argument_mattes,
     "an OpenEXR file also has mattes as Cryptomatte: cels, by their names, or names, of objects"},
    {"--onion", "B,A", &cs_argument_onion,
     "show the B drawings before (red) and the A drawings after (green), counted for each cel, "
     "behind the drawing of each frame"},
    {"--workers", "N", &cs_argument_workers,
     "the number of rendering threads; default: one per processor"},
    {"--progress", "HOW", &cs_argument_progress,
     "auto, bar, lines, none or json on standard error; openjd on standard output"},
    {"--force", NULL, NULL,
     "with --resume: keep every complete frame file, even if its content would differ"},
    {"--keep-going", NULL, NULL,
     "continue after frames that fail, or with --table after rows; the exit code is then 1"},
    {"--set", "NAME=V", &cs_argument_setting,
     "the value of a parameter that the script declares; may be given several times"},
    {"--set-from", "FILE", &cs_argument_file, "values of parameters, as a JSON object"},
    {"--trust", NULL, NULL,
     "give the script all of Lua, with files and programs, and no limits; decode pictures in this "
     "process, without limits"},
    {"--strict", NULL, NULL,
     "let the kernel confine the process too: no other files, no programs, no network"},
    {"--allow", "DIR", &cs_argument_texts,
     "let the script also read this folder and the folders in it; may be given several times"},
    {"--allow-system-fonts", NULL, NULL,
     "let the script also read the fonts that are installed: /usr/share/fonts, "
     "/usr/local/share/fonts, ~/.local/share/fonts and ~/.fonts"},
    {"--limit", "NAME=V", &cs_argument_limits,
     "limits, several separated by commas; 0: no limit. Of the script: memory=512M, steps=2e9 per "
     "frame, time=60 seconds of a processor per call, print=1M per frame; of rendering: "
     "render-memory=SIZE, by the memory there is; of decoding a picture: picture-memory=1G, "
     "picture-time=20 seconds per part. These values are the defaults"},
    {"--memory", "MiB", &cs_argument_memory,
     "the size of the caches of decoded pictures and defocused cels; default: 768; 0: every frame "
     "is rendered as if it were the first"},
    {"--json", NULL, NULL, "print the same as a JSON object"},
    {"--frame", "N", &cs_argument_integer, "the frame number; default: the first"},
    {"--scale", "S", &cs_argument_scale, "pixels per film unit, instead of --size"},
    {0}};

/* The rights of pictures, for verbs without a script. */
static const cs_option of_pictures[] = {
    {"--trust", NULL, NULL, "decode pictures in this process, without limits"},
    {"--limit", "NAME=V", &cs_argument_picture_limits,
     "limits of decoding a picture; 0: no limit. picture-memory=1G and picture-time=20 seconds per "
     "part are the defaults"},
    {0}};

/* Names that follow one another in several lists. */
#define CODING "--format --depth --colour --display --view --ocio --alpha "
#define DITHER "--dither --no-dither "
#define DRAWING "--flat --precision "
#define VIDEO "--quality --codec --max-size --crf --loudness --loop "
#define CELS "--background --cel --layers --cryptomatte --onion "
#define SCRIPT "--set --set-from --trust --strict --allow --allow-system-fonts --limit "
#define SETTINGS "--set --set-from "
#define PICTURES "--trust --limit "

/* ---------------------------------------------------------------- options of each */

static const cs_option RENDER[] = {
    {"-o", "OUT", &cs_argument_file,
     "shot.####.png, shot.%04d.exr, one.png for a single frame, - for raw frames; film.mp4, .mov, "
     ".webm, .mkv, .gif, .webp, .apng or .avif: a video; one.svg or film.pdf: drawings; film.json "
     "or film.lottie: a Lottie animation; name.ograf: a graphic for broadcast"},
    {"--engine", "DIR", &cs_argument_file,
     "of a graphic with parameters: the folder of celspan-web; default: beside the program"},
    {"--scale", "S", &cs_argument_scale,
     "pixels per film unit, instead of --size; of a drawing: of pictures in it, default: 2"},
    {"--draft", NULL, NULL, "half the size and no antialiasing (jagged), to look at a film soon"},
    {"--strip", "I/N", &cs_argument_share,
     "only the I-th of N strips of the frame, for 'celspan join'"},
    {"--task", "I/N", &cs_argument_task,
     "only the I-th of N parts of the frames, or with --table of the rows; env: as the array of a "
     "farm says, or env/N"},
    {"--hash", NULL, NULL, "print FRAME DIGEST for the pixels of each frame; -o may be omitted"},
    {"--resume", NULL, NULL,
     "keep the frames, or the video, of earlier runs with --resume that would not change"},
    {"--table", "FILE", &cs_argument_file,
     "a film for each row of a CSV file, whose columns are parameters, or {NAME} in OUT"},
    {"--log", "FILE", &cs_argument_file,
     "add each message and each frame to this file, with the time and the name of the machine"},
    {"--report", "FILE", &cs_argument_file,
     "write at the end, as JSON: the slowest frames, memory, and the versions of what made it"},
    {0}};

static const cs_option INFO[] = {
    {"--parameters", NULL, NULL, "only the parameters of a script"},
    {"--json", NULL, NULL, "print the same as a JSON object; with --parameters, as JSON Schema"},
    {"--parts-picture", "FILE", &cs_argument_file,
     "of an SVG drawing: a sheet of its elements with their numbers, which are also listed"},
    {0}};

static const cs_option FONTS[] = {
    {"--allow-system-fonts", NULL, NULL, "accepted, since the list always has those"}, {0}};

static const cs_option CHECK[] = {
    {"--deep", NULL, NULL,
     "read every picture completely, not only its header, and have ffmpeg read the sound"},
    {"--files", NULL, NULL, "print the files that the film reads: KIND SIZE SHA256 PATH"},
    {"--json", NULL, NULL,
     "print the faults as a JSON list on standard output; with --files, the files"},
    {"--table", "FILE", &cs_argument_file,
     "check the film of each row of a CSV file, whose columns are parameters"},
    {0}};

static const cs_option SPANS[] = {
    {"--rows", "A-B", &cs_argument_rows, "rows A to B, inclusive; default: all"},
    {"--stats", NULL, NULL,
     "make all rows, but print only statistics: a line of numbers, and one of words"},
    {"--pixels", "DEPTH", &cs_argument_depth,
     "with --stats: also convert each row to pixels of this depth, in a buffer that is reused"},
    {"--json", NULL, NULL, "with --stats: print the numbers as a JSON object"},
    {0}};

static const cs_option WATCH[] = {
    {"--port", "N", &cs_argument_port, "the port of the page; default: one that is free"},
    {"--open", NULL, NULL, "open the page in the browser"},
    {"--editor", "COMMAND", &cs_argument_text,
     "what a click on a line of the script starts, such as 'code -g {file}:{line}'"},
    {"--size", "WxH", &cs_argument_size,
     "pixels of a frame for programs that do not give a size; default: the film's"},
    {"-o", "DIR", &cs_argument_folder,
     "the folder of the files that the page renders; default: that of the script"},
    {0}};

static const cs_option CONVERT[] = {
    {"--scale", "S", &cs_argument_scale,
     "pixels per film unit, instead of --size; of a drawing: of pictures in it, default: 2"},
    {"--fps", "N", &cs_argument_rate, "of a video of pictures: their rate; default: 24"},
    {"--sound", "FILE", &cs_argument_file,
     "of a video: its sound, or a script, of whose film the sound is taken"},
    {0}};

static const cs_option PLANE[] = {
    {"-o", "PAGE", &cs_argument_file, "the page to write, an HTML file; with --windows, a plane"},
    {"--windows", "TABLE", &cs_argument_file,
     "a CSV file of planes to be shown in FILE, with columns x, y, width, height and plane"},
    {"--title", "TEXT", &cs_argument_text, "the title of the page; default: the name of the file"},
    {0}};

static const cs_option COMPARE[] = {
    {"--frame", "N", &cs_argument_integer, "of a plane file with a film: the frame, from 1"},
    {"-o", "DIFFERENCE", &cs_argument_file,
     "a picture of the differences: A in pale grey, what differs in red"},
    {"--fail", "D", &cs_argument_tolerance,
     "the largest difference of coded values (0..1) that is accepted; default: 0"},
    {0}};

static const cs_option TILES[] = {
    {"-o", "DIR", &cs_argument_folder,
     "the folder for the pyramid and its page; created if it is missing"},
    {"--crop", "X,Y,W,H", &cs_argument_crop,
     "only tiles that touch this part of the frame, in its pixels"},
    {"--format", "NAME", &cs_argument_layout,
     "dzi (Deep Zoom) or iiif (IIIF Image API 3.0, level 0); default: dzi"},
    {"--picture", "NAME", &cs_argument_picture, "png or jpg: the format of a tile; default: png"},
    {"--tile", "N", &cs_argument_tile, "the side of a tile in pixels; default: 254, iiif 512"},
    {"--overlap", "N", &cs_argument_pixels,
     "pixels that tiles share with their neighbours; default: 1, iiif 0"},
    {"--levels", "A-B", &cs_argument_levels,
     "the levels to make; level 0 is one pixel; default: all"},
    {"--places", "FILE", &cs_argument_file,
     "lines X Y WIDTH NAME: links in the page; more levels are made around these places"},
    {"--tiles-limit", "N", &cs_argument_count,
     "the largest number of tiles to make; default: 200000"},
    {"--skip-empty", NULL, NULL, "omit tiles that show only the background"},
    {"--sparse", NULL, NULL, "write a tile only where it holds more than the coarser one"},
    {"--fresh", NULL, NULL, "remove the tiles of an earlier run and start again"},
    {"--viewer", "PATH", &cs_argument_file_or_folder,
     "OpenSeadragon, a folder or file that is copied beside the page and replaces the built-in "
     "viewer"},
    {0}};

static const cs_option SHEET[] = {
    {"-o", "OUT", &cs_argument_file,
     "shot.xdts, shot.csv (TVPaint, Krita) or shot.txt, an edit list, cut.otio or cut.edl, or on "
     "paper, cut.pdf; default: text on standard output"},
    {"--media", "NAME", &cs_argument_text,
     "the file of each shot in an edit list, with {name} for its name, as in shots/{name}.mov"},
    {"--paper", "SIZE", &cs_argument_text,
     "of a sheet on paper, -o cut.pdf: a4 or a3; default: a4"},
    {"--font", "FILE", &cs_argument_file, "of its letters; default: capitals of celspan's own"},
    {0}};

static const cs_option SOUND[] = {
    {"-o", "OUT.wav", &cs_argument_file, "48,000 samples a second, stereo"},
    {"--depth", "DEPTH", &cs_argument_depth, "16 or float; default: 16"},
    {"--stems", NULL, NULL, "a file for each name of a sound, by {name} in OUT; others are 'rest'"},
    {"--resume", NULL, NULL, "keep the file of an earlier run with --resume that would not change"},
    {"--table", "FILE", &cs_argument_file,
     "a sound for each row of a CSV file, whose columns are parameters, or {NAME} in OUT"},
    {"--keep-going", NULL, NULL,
     "with --table: continue after rows that fail; the exit code is then 1"},
    {0}};

static const cs_option CONTACT[] = {
    {"-o", "SHEET", &cs_argument_file, "the picture to make; sheet.####.png for several pages"},
    {"--camera", NULL, NULL,
     "the way of the camera over the background instead: a rectangle for each second"},
    {"--palette", NULL, NULL, "the main colours by time instead, and the mean of each shot"},
    {"--grid", "CxR", &cs_argument_grid, "columns and rows of a page; default: 6x4"},
    {"--every", "N", &cs_argument_every, "one frame in N; default: as many as fit on one page"},
    {"--size", "WxH", &cs_argument_size, "pixels of each picture; each axis is scaled separately"},
    {"--scale", "S", &cs_argument_scale,
     "pixels of each picture per film unit, instead of --size; default: those of the film, at most "
     "480, and at most 3840 for all columns"},
    {"--table", "FILE", &cs_argument_file,
     "a sheet for each row of a CSV file, whose columns are parameters, or {NAME} in SHEET"},
    {0}};

static const cs_option SPRITES[] = {
    {"-o", "SHEET", &cs_argument_file,
     "the picture to make, such as sheet.png; beside it sheet.json"},
    {"--padding", "N", &cs_argument_pixels, "clear pixels around each sprite; default: 2"},
    {"--table", "FILE", &cs_argument_file,
     "a sheet for each row of a CSV file, whose columns are parameters, or {NAME} in SHEET"},
    {0}};

static const cs_option RELIGHT[] = {
    {"-o", "OUT", &cs_argument_file,
     "the picture in the light --to; without --to, an .exr that can be shown in any light"},
    {"--light", "COLOUR", &cs_argument_lamp,
     "the light in which IN was taken, #rrggbb or r,g,b; grey: the light in which the average of "
     "IN is a grey of 0.18"},
    {"--to", "COLOUR", &cs_argument_light, "the light in which to show it"},
    {0}};

static const cs_option TRACE[] = {
    {"-o", "OUT", &cs_argument_file,
     "art.svg, or art.lua: a script that shows the drawing and is also a module"},
    {"--colours", "N|LIST", &cs_argument_colours,
     "the number of colours to find, or a list of colours; default: 2"},
    {"--smooth", "S", &cs_argument_smooth,
     "how far curves may deviate from the edges; 0: the sides of the pixels; default: 1"},
    {"--speckle", "N", &cs_argument_pixels,
     "areas of at most N pixels are merged into their neighbours; default: 2"},
    {"--lines", NULL, NULL, "strokes along the drawing on the background, instead of areas"},
    {0}};

static const cs_option SCAN[] = {
    {"-o", "OUT", &cs_argument_file, "the clean drawings, such as clean/level.####.png"},
    {"--pegs", "KIND", &cs_argument_text,
     "acme: by the holes of the peg bar, the default; none: by the corners of the paper"},
    {"--match", NULL, NULL, "instead, by the best shift of the lines onto those of the first"},
    {"--dpi", "N", &cs_argument_every, "pixels for an inch; default: what the file says"},
    {"--levels", "A,B", &cs_argument_text,
     "the brightness of black and of white, 0 to 1; default: by paper and ink"},
    {"--ink", "NAME=COLOUR,...", &cs_argument_text,
     "the pencils, such as black=#222,red=#c33: each is also written to level.NAME.####.png"},
    {"--dust", "N", &cs_argument_pixels, "blots of at most N pixels are left out; default: 8"},
    {"--contact", "FILE", &cs_argument_file,
     "a picture of how each drawing was moved: its number, degrees, pixels to the right and down"},
    {"--json", NULL, NULL, "print how each drawing was moved as a JSON object"},
    {0}};

static const cs_option TRACK[] = {
    {"-o", "OUT.json", &cs_argument_file, "the track, for celspan.track; default: standard output"},
    {"--from", "N", &cs_argument_integer, "the frame in which the region is given"},
    {"--at", "X,Y,W,H", &cs_argument_crop, "the region in that frame, in pixels"},
    {"--model", "NAME", &cs_argument_model,
     "translation, similarity (also rotation and scale) or perspective; default: similarity"},
    {0}};

static const cs_option FARM[] = {
    {"-o", "OUT", &cs_argument_file,
     "the output of the job, as for render: shot.####.png, one.png for a single frame"},
    {"--slurm", NULL, NULL, "an array script for Slurm"},
    {"--openjd", NULL, NULL, "a template of Open Job Description 2023-09, in JSON"},
    {"--commands", NULL, NULL, "a command for each task, a line each"},
    {"--chunk", "N", &cs_argument_every,
     "the largest number of frames in a task; default: 10, or with --table 1 row"},
    {"--strips", "N", &cs_argument_every,
     "one frame in N strips, with a task for each strip and one that joins them"},
    {"--job-name", "NAME", &cs_argument_text,
     "the name of the job; default: the name of the script"},
    {"--job-memory", "MiB", &cs_argument_mebibytes, "the memory of each task; default: the farm's"},
    {"--job-time", "MIN", &cs_argument_minutes,
     "the minutes that each task may take; default: the farm's"},
    {"--logs", "DIR", &cs_argument_folder,
     "the folder for Slurm's task logs; default: Slurm's own"},
    {"--workers", "N", &cs_argument_workers,
     "processors, and threads, of each task; default: the farm's"},
    {"--log", "FILE", &cs_argument_file,
     "a log of each task, as for render: run.log is run.3.log for task 3"},
    {"--table", "FILE", &cs_argument_file,
     "a film for each row of a CSV file, as for render: tasks are rows"},
    {0}};

static const cs_option JOIN[] = {
    {"-o", "OUT", &cs_argument_file, "the picture to make, in the same format as the strips"}, {0}};

static const cs_option TEST[] = {
    {"--only", "PATTERN", &cs_argument_pattern, "only tests whose names match this Lua pattern"},
    {"--workers", "N", &cs_argument_workers,
     "the number of spec files at a time; default: one per processor"},
    {"--junit", "FILE", &cs_argument_file, "also write the results as XML, for CI servers"},
    {0}};

static const cs_option HELP[] = {
    {"--man", NULL, NULL, "the manual page"},
    {"--completion", "SHELL", &cs_argument_text, "completions for bash, zsh or fish"},
    {"--json", NULL, NULL, "all verbs and all names of Lua, as one JSON object"},
    {"--stderr", NULL, NULL, "the list of verbs, on standard error"},
    {0}};

/* ---------------------------------------------------------------- the verbs */

const cs_verb cs_verbs[] = {
    {"render", "SCRIPT -o OUT", 1, 1, .has_script = true,
     .summary = "Renders the frames of a film to files, a video or standard output.",
     .notes = "Missing folders are created and existing frames are replaced. A frame is either "
              "complete under its name or absent. Colours are computed in linear light. By "
              "default, integers have 8 bits, are sRGB-coded and have straight alpha; floats are "
              "linear with premultiplied alpha. With -o - the frames are written to standard "
              "output as rows of RGBA pixels, top to bottom, little endian. A video is made by "
              "ffmpeg, with the film's sound in sync: mp4 and mkv contain H.264 without alpha, mov "
              "ProRes 4444 and webm VP9, both with alpha.",
     .own = RENDER,
     .options =
         "-o --frames --engine --size --fit --scale --draft --crop --strip --task "
         "--antialias " CODING DITHER DRAWING VIDEO "--fps " CELS
         "--workers --progress --hash --resume --force --keep-going --table --log --report " SCRIPT
         "--memory "},
    {"info", "SCRIPT|FILE", 1, 1, .has_script = true,
     .summary =
         "Prints figures about a film, picture, movie, painting, drawing, span or plane file.",
     .notes = "The type of the file is detected from its content. Every frame of a film is built. "
              "Only the headers of a picture are read: format, size, channels, alpha, depth, "
              "colour, subimages and layers. Of a movie, the times of all pictures are read. A "
              "span or plane file is read to its end, and every checksum is verified.",
     .own = INFO, .options = "--parameters --json --parts-picture " SCRIPT},
    {"check", "SCRIPT", 1, 1, .has_script = true, .asks_warnings = true,
     .summary = "Builds every frame, and reports all faults and what viewers would miss.",
     .notes =
         "Each frame is built once, and one of every ten again, in another order in a fresh film: "
         "a frame function that then returns another scene is not a pure function of its frame, "
         "and all frames are built again. Every picture must exist, hidden or not, and so must the "
         "film's sound. Frames with scan-line procedures are built, but not compared. A value that "
         "the script throws away is a warning, and so is what viewers cannot read or should be "
         "spared: text outside of the frame, covered, of low contrast or shown too briefly, a "
         "second that is empty or frozen without a sheet, and flashes by WCAG 2.3.1. Equal faults "
         "are reported in one line, with all frames that have them.",
     .own = CHECK, .options = "--frames --deep --files --json --ocio --table " SCRIPT},
    {"describe", "SCRIPT", 1, 1, .has_script = true, .asks_warnings = true,
     .summary = "Describes a film as text: shots, who is seen when, words, what stands still.",
     .notes = "Every frame is built, and each that differs from the one before is seen at a grid "
              "of points. Times are seconds of the film. share is the part of the frame that the "
              "box around a cel, an object with a name or a text takes at most.",
     .options = "--frames --json " SCRIPT},
    {"watch", "SCRIPT [SCRIPT]", 1, 2, .has_script = true, .runs_again = true,
     .summary = "Shows a film in the browser while its script is being written.",
     .notes = "Prints the address of a page that only this machine can reach and that asks for the "
              "token in the address. The page plays the film, zooms into it, and shows it again "
              "whenever the script, or a file that it reads, is saved. After an error the last "
              "good picture stays, with the error over it. Ctrl-C ends it.",
     .own = WATCH, .options = "--port --open --editor --size -o --workers " SCRIPT "--memory "},
    {"play", "SCRIPT", 1, 1, .has_script = true, .runs_again = true,
     .summary = "Opens a film in the browser and plays it.",
     .notes = "The same as 'celspan watch --open', with the picture alone in the window; the key f "
              "fills the screen.",
     .own = WATCH, .options = "--port --open --editor --size -o --workers " SCRIPT "--memory "},
    {"spans", "SCRIPT|FILE", 1, 1, .has_script = true,
     .summary = "Prints the spans of a frame or a plane file as text.",
     .notes = "One line a span, colours linear and premultiplied, columns half-open, rows from 0:\n"
              "  row x0 x1 single r g b a\n"
              "  row x0 x1 gradient r g b a r g b a     colours of the first and the last pixel\n"
              "  row x0 x1 array N",
     .own = SPANS,
     .options =
         "--frame --size --rows --antialias --workers --stats --pixels --json " SCRIPT "--memory "},
    {"probe", "SCRIPT X Y", 3, 3, .has_script = true,
     .summary = "Prints the colour of one point as r g b a, linear and premultiplied.",
     .notes = "X and Y are film units. The scene is evaluated directly at the point, without "
              "antialiasing or defocus.",
     .options = "--frame --json " SCRIPT},
    {"convert", "IN OUT", 2, 2,
     .summary = "Converts a picture, painting, drawing, span or plane file to another format or "
                "size; numbered pictures or a movie to a video.",
     .own = CONVERT,
     .options = "--frame --size --scale --crop " CODING DRAWING VIDEO
                "--fps --sound --background --progress --workers " PICTURES},
    {"plane", "[FILE] -o PAGE", 0, 1,
     .summary = "Makes a page that shows a plane file at any size.",
     .notes = "The plane and its decoder, as WebAssembly, are in the page, which needs nothing "
              "else. It moves and zooms with mouse, touch and keyboard, and draws the visible part "
              "at the size at which it is shown. The page of a film has all of its frames: the "
              "space bar plays it, and comma and full stop show the frame before and the next one. "
              "Without FILE, -o celspan-film.js writes the element <celspan-film> for other pages. "
              "With --windows, -o is a plane file that has all planes of the table, too.",
     .own = PLANE, .options = "-o --title --windows "},
    {"compare", "A B", 2, 2,
     .summary = "Compares two pictures or films: the exit code is 0 if they show the same, else 1.",
     .notes = "Prints the largest difference of coded values (0..1: sRGB, straight alpha), its "
              "position, and how many pixels differ by more than --fail. If A and B are patterns "
              "such as shot.####.png, a line is printed for each frame.",
     .own = COMPARE, .options = "--frame -o --fail --json " PICTURES},
    {"tiles", "SCRIPT|FILE -o DIR", 1, 1, .has_script = true, .makes_folder = true,
     .summary = "Cuts a frame or a picture into tiles, with a page to explore it in a browser.",
     .notes =
         "Makes a pyramid of tiles directly from the scene, and index.html, which shows it. A name "
         "that ends in .lua is a script; a FILE is any picture, drawing or painting. Equal tiles "
         "are one file with several names. A run that was stopped continues where it stopped.",
     .own = TILES,
     .options =
         "-o --frame --size --scale --crop --antialias --format --workers --progress --picture "
         "--tile --overlap --levels --places --tiles-limit --skip-empty --sparse --fresh "
         "--viewer " SCRIPT},
    {"sheet", "FILE|SCRIPT", 1, 1, .has_script = true,
     .summary = "Prints or converts an exposure sheet, or writes the sheet of a film.",
     .notes =
         "A name that ends in .lua is a script. A FILE is an exposure sheet: XDTS, the CSV of "
         "TVPaint, Krita or Clip Studio, an OCA folder, or the text that this verb prints. The "
         "sheet of a film has a column for each cel and object with a name, and for each cel "
         "without one, by its position. Drawings are numbered in the order in which they appear:\n"
         "  |   the same drawing as above\n"
         "  -   no drawing\n"
         "  /m  the placement, fade, viewport or lights changed\n"
         "  /p  drawn by a procedure, so not compared",
     .own = SHEET, .options = "-o --frames --media --paper --font --json " SCRIPT},
    {"sound", "SCRIPT -o OUT.wav", 1, 1, .has_script = true,
     .summary = "Writes the sound of a film, mixed as for a video.",
     .notes =
         "Sounds are decoded by ffmpeg, and mixed here. The file is as long as the frames. Louder "
         "parts than 16 bits hold are cut, which is reported. OUT is either complete or absent.",
     .own = SOUND,
     .options =
         "-o --frames --depth --loudness --stems --resume --table --keep-going --progress " SCRIPT},
    {"contact", "SCRIPT -o SHEET", 1, 1, .has_script = true,
     .summary = "Makes a contact sheet: frames side by side, each with its number.",
     .notes = "Without --every, as many frames are left out as necessary to fit on one page. With "
              "--every, SHEET needs a number, as in sheet.####.png, if the frames do not fit on "
              "one page. The last frame is always shown.",
     .own = CONTACT,
     .options = "-o --frames --camera --palette --grid --every --size --scale --onion --table "
                "--workers --progress " SCRIPT},
    {"sprites", "SCRIPT -o SHEET", 1, 1, .has_script = true,
     .summary = "Puts the frames of a film on one sheet, for games.",
     .notes =
         "What is clear around a frame is left out, and equal frames are there once. sheet.json, "
         "in the hash form of TexturePacker, says where each frame is on the sheet.",
     .own = SPRITES,
     .options = "-o --frames --size --scale --padding --table --workers --progress " SCRIPT},
    {"relight", "IN -o OUT", 1, 1,
     .summary = "Removes the light from a picture, and shows the picture in another light.",
     .notes = "IN is a picture, a drawing or a painting, and --light is the light in which it was "
              "taken. Highlights are kept. Without --to, OUT is an EXR file of seven channels that "
              "can be shown in any light: by celspan.relight, or as the IN of another run, which "
              "then needs no --light.",
     .own = RELIGHT, .options = "-o --light --to " CODING PICTURES},
    {"trace", "IN -o OUT", 1, 1,
     .summary = "Turns a scanned or flat-coloured drawing into shapes: SVG, or a script.",
     .notes = "IN is a picture, or a drawing or a painting as it is rendered. Areas of one colour "
              "become closed paths of lines and cubic curves. Adjacent areas share their border, "
              "so there are no gaps between them. A script can be rendered, and other scripts can "
              "require it to use its shapes. OUT is either complete or absent.",
     .own = TRACE, .options = "-o --colours --smooth --speckle --lines " PICTURES},
    {"scan", "PATTERN -o OUT", 1, 1,
     .summary = "Registers scanned drawings by their peg holes, and cleans them.",
     .notes = "PATTERN names scans by number, such as rough.####.png. Each is turned and moved so "
              "that all lie alike, on the pegs of ACME, and becomes lines on a clear ground. A "
              "scan that cannot be registered ends the run, with its name and what to do.",
     .own = SCAN,
     .options = "-o --pegs --match --dpi --levels --ink --dust --contact --frames --json " CODING
                "--progress " PICTURES},
    {"track", "PATTERN --from N --at X,Y,W,H", 1, 1,
     .summary = "Follows a region through frames, and writes its position in each frame.",
     .notes = "PATTERN names pictures by number, such as head.####.png. Frames in which the region "
              "is not found are reported as lost. The module celspan.track reads the track and "
              "places art on it.",
     .own = TRACK, .options = "-o --from --at --model --frames " PICTURES},
    {"farm", "SCRIPT -o OUT", 1, 1, .has_script = true, .runs_again = true, .plans_rows = true,
     .asks_files = true,
     .summary =
         "Writes a job for a render farm: an array script for Slurm, or an Open Job Description.",
     .notes =
         "The job is written to standard output. Its tasks render the frames to OUT as 'celspan "
         "render' does: in chunks that continue where they were stopped, or one frame in strips, "
         "which are joined at the end. With --table its tasks render rows of the table.",
     .own = FARM,
     .options =
         "-o --slurm --openjd --commands --chunk --strips --job-name --job-memory --job-time "
         "--logs --workers --frames --size --fit --scale --crop --antialias " CODING DITHER VIDEO
         "--fps " CELS "--force --keep-going --log --table " SCRIPT "--memory "},
    {"join", "STRIP ... -o OUT", 1, CS_OPERANDS_MAX,
     .summary = "Joins strips of a frame without decompressing them.",
     .notes = "STRIPs are PNG, Targa or span files made by 'celspan render --strip', from top to "
              "bottom, or a pattern such as strips/####.png. OUT shows the same as the frame "
              "rendered as a whole, and is either complete or absent.",
     .own = JOIN, .options = "-o "},
    {"test", "[SPEC ...]", 0, CS_OPERANDS_MAX,
     .summary = "Runs specs with busted and the assertions of celspan.spec.",
     .notes = "A SPEC is a file, or a folder, of which all files that end in _spec.lua are run; "
              "the default is the folder spec. Each file runs in its own process, several at a "
              "time. The exit code is 1 if a test failed, and 5 if busted is not installed.",
     .own = TEST, .options = "--only --workers --junit " SETTINGS},
    {"fonts", "[SCRIPT]", 0, 1, .summary = "Lists the fonts that a film may read.",
     .notes =
         "First those in the folder of the script, by default the current one, as a script names "
         "them; then those of the system, which a script may read with --allow-system-fonts.",
     .own = FONTS, .options = "--json --allow-system-fonts "},
    {"init", "NAME", 1, 1,
     .summary = "Creates a film of six seconds to start from: scripts, sound, spec, settings for "
                "editors, README.",
     .notes = "NAME is a new or empty folder. The film renders and its tests pass without changes.",
     .options = ""},
    {"help", "[WORDS]", 0, CS_OPERANDS_MAX, .is_hidden = true, .own = HELP,
     .options = "--man --completion --json --stderr "},
    {"stage", "SCRIPT", 1, 1, .is_hidden = true, .has_script = true, .asks_files = true,
     .asks_warnings = true, .runs_again = true, .options = "--workers " SCRIPT "--memory "},
    {"spec", "-- FILE [PATTERN]", 0, 0, .is_hidden = true, .has_script = true, .runs_others = true,
     .options = SETTINGS},
    {0}};

/* ---------------------------------------------------------------- finding */

/* The row of the name at the beginning of a text; NULL: there is none. Names have two characters at
 * least; the third one differs in most of them. */
static const cs_option *find(const cs_option *rows, const char *text) {
  const size_t size = strcspn(text, " ");
  while (rows->name && ((size > 2 && rows->name[2] != text[2]) ||
                        strncmp(rows->name, text, size) != 0 || rows->name[size]))
    rows++;
  return rows->name ? rows : NULL;
}

const cs_option *cs_verb_option(const cs_verb *verb, const char **at) {
  const char *name = *at;
  const cs_option *found = verb->own ? find(verb->own, name) : NULL;
  if (!found && !verb->has_script)
    found = find(of_pictures, name);
  *at += strcspn(name, " ") + 1;
  return found ? found : find(shared, name);
}

const cs_verb *cs_verb_named(const char *name) {
  for (const cs_verb *verb = cs_verbs; verb->name; verb++)
    if (strcmp(verb->name, name) == 0)
      return verb;
  return NULL;
}
