/* The verbs: what each takes, and what its help says. Texts are wrapped where they are printed; lines
 * that begin with a space are left as they are. */
#include "program/verbs.h"

/* ---------------------------------------------------------------- options of several verbs */

#define OUTPUT(value, help)                                                                        \
  { "-o", value, &cs_argument_file, help }
#define FRAMES                                                                                     \
  { "--frames", "LIST", &cs_argument_frames, "the frames, such as 1-10,20-30:2,45; default: all" }
#define FRAME                                                                                      \
  { "--frame", "N", &cs_argument_integer, "the frame; default: the first" }
#define SIZE                                                                                       \
  {                                                                                                \
    "--size", "WxH", &cs_argument_size,                                                            \
        "pixels of the whole frame; each axis is scaled on its own"                                \
  }
#define SCALE                                                                                      \
  { "--scale", "S", &cs_argument_scale, "pixels a film unit, instead of --size" }
#define CROP                                                                                       \
  { "--crop", "X,Y,W,H", &cs_argument_crop, "the part to make, in pixels of the output" }
#define ANTIALIAS                                                                                  \
  {                                                                                                \
    "--antialias", "MODE", &cs_argument_antialias,                                                 \
        "area (the mean over each pixel), none (pixel centres), or KERNEL[:ROWS]: box, gaussian, " \
        "mitchell or lanczos; ROWS: parts of a pixel row, 16"                                      \
  }
#define WORKERS                                                                                    \
  { "--workers", "N", &cs_argument_workers, "threads that render; default: one a processor" }
/* The coding of a file's pixels. */
#define CODING                                                                                     \
  {"--format", "NAME", &cs_argument_format, "file format; default: by the ending of OUT"},         \
      {"--depth", "DEPTH", &cs_argument_depth, "8, 16, half or float; default: by the format"},    \
      {"--colour", "CODING", &cs_argument_colour,                                                  \
       "srgb, linear, rec709 or cineon; default: srgb, floats linear"},                            \
  {                                                                                                \
    "--alpha", "KIND", &cs_argument_alpha,                                                         \
        "straight or premultiplied; default: straight, floats premultiplied"                       \
  }
#define DITHER                                                                                     \
  { "--dither", NULL, NULL, "8 bits without bands: rounded up or down by the place of the pixel" }
#define BACKGROUND                                                                                 \
  {                                                                                                \
    "--background", "RGB", &cs_argument_tint,                                                      \
        "a back light of this colour and matte 1 behind everything"                                \
  }
#define CEL                                                                                        \
  { "--cel", "NAME", &cs_argument_cel, "only the cels of this name (cel:named), with their lights" }
#define ONION                                                                                      \
  {                                                                                                \
    "--onion", "B,A", &cs_argument_onion,                                                          \
        "lay B frames before (red) and A after (green) over each frame"                            \
  }
#define FORCE                                                                                      \
  {                                                                                                \
    "--force", NULL, NULL,                                                                         \
        "with --resume: keep every complete frame file, even if its content would differ"          \
  }
#define KEEP_GOING                                                                                 \
  { "--keep-going", NULL, NULL, "go on after frames that fail; the exit code is then 1" }
#define MEMORY                                                                                     \
  {                                                                                                \
    "--memory", "MiB", &cs_argument_memory,                                                        \
        "pictures and defocused cels kept in memory; default: 768; 0: every frame is made as if "  \
        "it "                                                                                      \
        "were the first"                                                                           \
  }
#define PROGRESS                                                                                   \
  {                                                                                                \
    "--progress", "HOW", &cs_argument_progress,                                                    \
        "auto, bar, lines, none or json on standard error; openjd on standard output"              \
  }
/* The rights of a script. */
#define RIGHTS                                                                                     \
  {"--trust", NULL, NULL,                                                                          \
   "give the script the whole of Lua: files, programs, no limits; decode pictures in this "        \
   "process, without limits"},                                                                     \
      {"--strict", NULL, NULL,                                                                     \
       "confine the process too, by the kernel: no other files, programs or network"},             \
      {"--allow", "DIR", &cs_argument_texts,                                                       \
       "let the script read below this folder too; may be given several times"},                   \
  {                                                                                                \
    "--limit", "NAME=V", &cs_argument_limits,                                                      \
        "limits of the script: memory=512M, steps=2e9 (a frame), time=60 (seconds a call), "       \
        "print=1M (a frame) are the defaults; of rendering: render-memory=SIZE, three quarters "   \
        "of the machine's; of decoding a picture: picture-memory=1G, picture-time=20 (seconds a "  \
        "part); several with commas; 0: none"                                                      \
  }
/* The rights of pictures, where there is no script. */
#define PICTURE_RIGHTS                                                                             \
  {"--trust", NULL, NULL, "decode pictures in this process, without limits"}, {                    \
    "--limit", "NAME=V", &cs_argument_picture_limits,                                              \
        "limits of decoding a picture: picture-memory=1G, picture-time=20 (seconds a part) are "   \
        "the defaults; 0: none"                                                                    \
  }

/* ---------------------------------------------------------------- options of each */

static const cs_option NONE[] = {{0}};

static const cs_option RENDER[] = {
    OUTPUT("OUT", "shot.####.png, shot.%04d.exr, one.png for a single frame, - for raw frames; "
                  "film.mp4, .mov, .webm, .mkv, .gif or .webp: a video, by ffmpeg"),
    FRAMES,
    SIZE,
    SCALE,
    CROP,
    {"--strip", "I/N", &cs_argument_share, "the I-th of N strips of the frame, for 'celspan join'"},
    {"--task", "I/N", &cs_argument_share, "the I-th of N parts of the frames"},
    ANTIALIAS,
    CODING,
    DITHER,
    {"--quality", "Q", &cs_argument_quality,
     "of a video: 0 (small) to 100 (hardly any loss); default: 75"},
    BACKGROUND,
    CEL,
    ONION,
    WORKERS,
    PROGRESS,
    {"--hash", NULL, NULL, "print FRAME DIGEST for each frame's pixels; OUT may be left out"},
    {"--resume", NULL, NULL,
     "keep the frames of earlier runs with --resume that would be the same again"},
    FORCE,
    KEEP_GOING,
    RIGHTS,
    MEMORY,
    {0}};

static const cs_option INFO[] = {RIGHTS, {0}};

static const cs_option CHECK[] = {
    FRAMES, {"--deep", NULL, NULL, "read pictures whole, not only their headers"}, RIGHTS, {0}};

static const cs_option SPANS[] = {
    FRAME,
    SIZE,
    {"--rows", "A-B", &cs_argument_rows, "rows from A to B, both included; default: all"},
    ANTIALIAS,
    WORKERS,
    {"--stats", NULL, NULL, "make all rows, count their spans by kind, print one line of counts"},
    {"--pixels", "DEPTH", &cs_argument_depth,
     "with --stats: make each row as pixels, in a row that is reused"},
    RIGHTS,
    MEMORY,
    {0}};

static const cs_option PROBE[] = {FRAME, RIGHTS, {0}};

static const cs_option CONVERT[] = {SIZE, CROP, CODING, WORKERS, PICTURE_RIGHTS, {0}};

static const cs_option COMPARE[] = {
    OUTPUT("DIFFERENCE", "a picture of where they differ: A in pale grey, differences in red"),
    {"--fail", "D", &cs_argument_tolerance,
     "largest difference of coded values (0..1) that is accepted; default 0"},
    PICTURE_RIGHTS,
    {0}};

static const cs_option TILES[] = {
    {"-o", "DIR", &cs_argument_folder,
     "the folder for the pyramid and its page; made when it is missing"},
    FRAME,
    SIZE,
    SCALE,
    {"--crop", "X,Y,W,H", &cs_argument_crop,
     "only tiles that touch this part of the frame, in its pixels"},
    ANTIALIAS,
    {"--format", "NAME", &cs_argument_layout,
     "dzi (Deep Zoom) or iiif (IIIF Image API 3.0, level 0); default: dzi"},
    WORKERS,
    PROGRESS,
    {"--picture", "NAME", &cs_argument_picture, "png or jpg: the format of a tile; default: png"},
    {"--tile", "N", &cs_argument_tile, "pixels of a tile's side; default: 254, iiif 512"},
    {"--overlap", "N", &cs_argument_pixels,
     "pixels that tiles share with their neighbours; default: 1, iiif 0"},
    {"--levels", "A-B", &cs_argument_levels, "levels to make, 0 is one pixel; default: all"},
    {"--places", "FILE", &cs_argument_file,
     "lines X Y WIDTH NAME: links in the page; deeper levels are made around them"},
    {"--tiles-limit", "N", &cs_argument_count, "tiles to make at most; default: 200000"},
    {"--skip-empty", NULL, NULL, "leave out tiles that show nothing but the background"},
    {"--fresh", NULL, NULL, "remove the tiles of an earlier run and start over"},
    {"--viewer", "PATH", &cs_argument_file_or_folder,
     "OpenSeadragon, which is copied beside the page and replaces its own viewer"},
    RIGHTS,
    {0}};

static const cs_option SHEET[] = {
    OUTPUT("OUT",
           "shot.xdts, shot.csv (TVPaint, Krita) or shot.txt; default: text on standard output"),
    FRAMES,
    RIGHTS,
    {0}};

static const cs_option CONTACT[] = {
    OUTPUT("SHEET", "the picture to make; sheet.####.png for several pages"),
    FRAMES,
    {"--grid", "CxR", &cs_argument_grid, "columns and rows of a page; default: 6x4"},
    {"--every", "N", &cs_argument_every,
     "one frame in N; default: the number that fits on one page"},
    WORKERS,
    RIGHTS,
    {0}};

static const cs_option RELIGHT[] = {
    OUTPUT("OUT", "the picture in the light --to; without it an .exr that takes any light"),
    {"--light", "COLOUR", &cs_argument_lamp,
     "the light that IN was taken in; grey: that in which its mean is a grey of 0.18"},
    {"--to", "COLOUR", &cs_argument_light, "the light to show it in"},
    CODING,
    PICTURE_RIGHTS,
    {0}};

static const cs_option TRACE[] = {
    OUTPUT("OUT", "art.svg, or art.lua: a script that shows the drawing, and is a module"),
    {"--colours", "N|LIST", &cs_argument_colours,
     "how many colours are found in the picture, or a list of them; default: 2"},
    {"--smooth", "S", &cs_argument_smooth,
     "how far curves may leave the edges; 0: the sides of the pixels; default: 1"},
    {"--speckle", "N", &cs_argument_pixels,
     "areas of at most N pixels go to their neighbours; default: 2"},
    {"--lines", NULL, NULL, "strokes along what is drawn on the ground, instead of areas"},
    PICTURE_RIGHTS,
    {0}};

static const cs_option TRACK[] = {
    OUTPUT("OUT.json", "the track, for celspan.track; default: on standard output"),
    {"--from", "N", &cs_argument_integer, "the frame in which the region is given"},
    {"--at", "X,Y,W,H", &cs_argument_crop, "the region in that frame, in pixels"},
    {"--model", "NAME", &cs_argument_model,
     "translation, similarity (turned and scaled too) or perspective; default: similarity"},
    FRAMES,
    PICTURE_RIGHTS,
    {0}};

static const cs_option FARM[] = {
    OUTPUT("OUT",
           "the output of the job, as for render: shot.####.png, one.png for a single frame"),
    {"--slurm", NULL, NULL, "an array script for Slurm"},
    {"--openjd", NULL, NULL, "a template of Open Job Description 2023-09, in JSON"},
    {"--chunk", "N", &cs_argument_every, "at most N frames a task; default: 10"},
    {"--strips", "N", &cs_argument_every,
     "one frame in N strips, a task each, and a task that joins them"},
    {"--job-name", "NAME", &cs_argument_text, "the name of the job; default: that of the script"},
    {"--job-memory", "MiB", &cs_argument_mebibytes,
     "memory of each task; default: that of the farm"},
    {"--job-time", "MIN", &cs_argument_minutes, "minutes of each task; default: that of the farm"},
    {"--logs", "DIR", &cs_argument_folder, "directory for Slurm's task logs; default: Slurm's own"},
    {"--workers", "N", &cs_argument_workers,
     "processors, and threads, of each task; default: that of the farm"},
    FRAMES,
    SIZE,
    SCALE,
    CROP,
    ANTIALIAS,
    CODING,
    DITHER,
    BACKGROUND,
    CEL,
    ONION,
    FORCE,
    KEEP_GOING,
    RIGHTS,
    MEMORY,
    {0}};

static const cs_option JOIN[] = {
    OUTPUT("OUT", "the picture to make; its ending is that of the strips"), {0}};

static const cs_option TEST[] = {
    {"--only", "PATTERN", &cs_argument_pattern, "only tests whose names match this Lua pattern"},
    {"--workers", "N", &cs_argument_workers, "spec files at a time; default: one a processor"},
    {0}};

static const cs_option HELP[] = {{"--man", NULL, NULL, "the manual page"},
                                 {"--stderr", NULL, NULL, "the list of verbs, on standard error"},
                                 {0}};

/* ---------------------------------------------------------------- the verbs */

const cs_verb cs_verbs[] = {
    {"render", "SCRIPT -o OUT", 1, 1, .has_script = true,
     .summary = "Renders the frames of a film to files, or raw to standard output.",
     .notes =
         "Missing folders are made and existing frames are replaced; a frame appears under its "
         "name whole or not at all. Colours are computed in linear light. By default integers are "
         "8 bit, sRGB-coded, alpha straight; floats are linear, alpha premultiplied. With -o - "
         "RGBA rows go to standard output, top to bottom, little endian. A video is made by "
         "ffmpeg, with the film's sound in step: mp4 and mkv hold H.264, mov ProRes 4444 and webm "
         "VP9, both with alpha.",
     .options = RENDER, .run = cs_verb_render},
    {"info", "SCRIPT|FILE", 1, 1, .has_script = true,
     .summary = "Prints frames, size, cels, primitives and pictures of a film; or the facts of a "
                "picture or span file.",
     .notes = "The content of the file decides which it is. Of a picture the headers are read: "
              "format, size, channels, alpha, depth, colour, subimages and layers. A span file is "
              "read to its end and every checksum is verified.",
     .options = INFO},
    {"check", "SCRIPT", 1, 1, .has_script = true,
     .summary = "Builds every frame without rendering and reports all faults.",
     .notes = "Each frame is built twice, the second time in another order in a fresh film: a "
              "frame function that answers differently is not a pure function of its frame. Every "
              "picture is looked for, hidden or not. Frames that hold scan-line procedures are "
              "built, but not compared. Equal faults are one line, with the frames that have them.",
     .options = CHECK},
    {"spans", "SCRIPT", 1, 1, .has_script = true, .summary = "Prints the spans of a frame as text.",
     .notes = "One line a span, colours linear and premultiplied, columns half-open, rows from 0:\n"
              "  row x0 x1 single r g b a\n"
              "  row x0 x1 gradient r g b a r g b a     colours of the first and the last pixel\n"
              "  row x0 x1 array N",
     .options = SPANS, .run = cs_verb_spans},
    {"probe", "SCRIPT X Y", 3, 3, .has_script = true,
     .summary = "Prints r g b a of one point, by direct evaluation: linear, premultiplied.",
     .notes = "X and Y are film units. There is no antialiasing and no defocus at a point.",
     .options = PROBE},
    {"convert", "IN OUT", 2, 2, .summary = "Converts any picture to any other.",
     .options = CONVERT},
    {"compare", "A B", 2, 2,
     .summary = "Compares two pictures or films: exit 0 when they show the same, 1 when not.",
     .notes =
         "Prints the largest difference of coded values (0..1: sRGB, alpha straight), where it "
         "is, and how many pixels differ by more than --fail. A and B may be patterns such as "
         "shot.####.png: then there is a line for each frame.",
     .options = COMPARE},
    {"tiles", "SCRIPT|FILE -o DIR", 1, 1, .has_script = true, .makes_folder = true,
     .summary = "Cuts a frame or a picture into tiles for exploring it in a browser.",
     .notes = "Makes a pyramid of tiles straight from the scene, and index.html, which shows it. A "
              "FILE is any picture; a name that ends in .lua is a script. Equal tiles are one file "
              "with several names. A run that was stopped continues where it was.",
     .options = TILES, .run = cs_verb_tiles},
    {"sheet", "FILE|SCRIPT", 1, 1, .has_script = true,
     .summary = "Prints an exposure sheet as text, converts it, or writes the sheet of a film.",
     .notes =
         "A FILE is an exposure sheet: XDTS, the CSV of TVPaint, Krita or Clip Studio, an OCA "
         "folder, or the text that is printed; a name that ends in .lua is a script. The sheet "
         "of a film has a row for each cel and object with a name, and for cels without one by "
         "their places. Drawings are numbered as they appear:\n"
         "  |   the drawing above goes on\n"
         "  -   there is no drawing\n"
         "  /m  its placement, fade, viewport or lights changed\n"
         "  /p  a procedure draws it: not compared",
     .options = SHEET},
    {"contact", "SCRIPT -o SHEET", 1, 1, .has_script = true,
     .summary = "Makes a sheet of frames side by side, each with its number.",
     .notes = "Without --every the frames are thinned until they fit on one page. With it, SHEET "
              "needs a number such as sheet.####.png when there are more frames than cells.",
     .options = CONTACT},
    {"relight", "IN -o OUT", 1, 1,
     .summary = "Takes the light off a picture, and shows it in another light.",
     .notes = "IN is any picture, and --light what it was taken in; highlights are kept. Without "
              "--to OUT is an EXR file of seven channels, which takes any light: for "
              "celspan.relight, or as IN of another run, which needs no --light.",
     .options = RELIGHT},
    {"trace", "IN -o OUT", 1, 1,
     .summary = "Turns a scanned or flat-coloured drawing into shapes: SVG, or a script.",
     .notes = "IN is any picture. Areas of one colour become closed paths of lines and cubics; "
              "adjacent areas share their border, so that there are no gaps between them. A script "
              "renders as it is, and gives its shapes to other scripts by require. OUT appears "
              "whole or not at all.",
     .options = TRACE},
    {"track", "PATTERN --from N --at X,Y,W,H", 1, 1,
     .summary = "Follows a region through frames, and writes its position in each.",
     .notes = "PATTERN names pictures with a number, such as head.####.png. Frames in which the "
              "region was not found are reported as lost. The track is for celspan.track, which "
              "places art on it.",
     .options = TRACK},
    {"farm", "SCRIPT -o OUT", 1, 1, .has_script = true,
     .summary = "Writes a job for a render farm: a Slurm array script, or an Open Job Description.",
     .notes = "The job goes to standard output. Its tasks render the frames to OUT as 'celspan "
              "render' would, in chunks that continue where they were stopped, or one frame in "
              "strips, which are joined at the end.",
     .options = FARM},
    {"join", "STRIP ... -o OUT", 1, CS_OPERANDS_MAX,
     .summary = "Puts strips of a frame together, without unpacking them.",
     .notes = "STRIPs are PNG, Targa or span files of 'celspan render --strip', from the top down, "
              "or a pattern such as strips/####.png. OUT shows what the whole frame would, and "
              "appears whole or not at all.",
     .options = JOIN},
    {"test", "[SPEC ...]", 0, CS_OPERANDS_MAX,
     .summary = "Runs specs in busted, with the assertions of celspan.spec.",
     .notes = "A SPEC is a file, or a folder whose files that end in _spec.lua are run; default: "
              "spec. Each file is run in a process of its own, several at a time. Exit code 1 when "
              "a test failed, 5 when busted is not installed.",
     .options = TEST},
    {"init", "NAME", 1, 1,
     .summary = "Lays out a film: script, sheet, spec, settings for editors, a page about it.",
     .notes = "NAME is a folder, new or empty. The film renders and its tests pass as they are.",
     .options = NONE},
    {"help", "[VERB]", 0, 1, .is_hidden = true, .options = HELP},
    {"spec", "-- FILE [PATTERN]", 0, 0, .is_hidden = true, .has_script = true, .options = NONE},
    {0}};
