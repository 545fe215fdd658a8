--- Words that people know from other programs, and the words of celspan's titles, keywords and
--- names with the same or the nearest meaning: { theirs, ours, ... }. `celspan help` searches for
--- all.
return {
  -- another spelling
  { "color", "colour" }, { "gray", "grades" }, { "grey", "grades" }, { "center", "align" },
  { "lipsync", "lips", "lip cels" }, { "timelapse", "time lapse" },
  { "greenscreen", "green screen" },

  -- time
  { "tween", "ease" }, { "inbetween", "ease", "morph" }, { "interpolation", "ease", "keys" },
  { "keyframe", "keys" }, { "key", "keys", "keyer" }, { "motion blur", "shutter", "exposures" },
  { "shutter angle", "shutter" }, { "slow motion", "retime" }, { "speed ramp", "retime" },
  { "slowmo", "retime" }, { "time remap", "retime" }, { "speed", "retime" },
  { "freeze frame", "retime" }, { "on twos", "the frame" }, { "frame rate", "film and frames" },
  { "fps", "film and frames" }, { "resolution", "film and frames" },
  { "aspect ratio", "film and frames" }, { "ghost", "onion skin" }, { "timeline", "the cut" },
  { "edit", "the cut" }, { "dope sheet", "exposure sheets" }, { "xsheet", "exposure sheets" },
  { "expression", "easing keys paths" }, { "bounce", "ease", "squash" },
  { "random", "noise", "wiggle" }, { "posterise time", "the frame" },
  { "posterize time", "the frame" }, { "trail", "echo" }, { "follow through", "what follows" },

  -- characters
  { "rig", "bones", "puppets" }, { "skeleton", "bones" }, { "joint", "bones" }, { "ik", "bones" },
  { "inverse kinematics", "bones" }, { "cutout", "puppets" }, { "walk cycle", "walk" },
  { "run cycle", "walk" }, { "lip sync", "lips", "lip cels" }, { "lip", "lip cels" },
  { "mouth", "lip cels", "lips" }, { "phoneme", "lip cels" }, { "viseme", "lip cels" },
  { "rhubarb", "lip cels" }, { "physics", "what follows", "spring" }, { "hair", "what follows" },
  { "puppet pin", "warp" }, { "mesh", "warp" }, { "deform", "warp", "bending" },
  { "turntable", "a head that turns" }, { "smart bone", "bones" }, { "switch", "lip cels", "show" },
  { "painted weight", "pictures that bend" }, { "feet", "a walk" }, { "foot", "a walk" },
  { "tail", "what follows" }, { "scarf", "what follows" },

  -- light, colour and lenses
  { "blur", "defocus" }, { "gaussian blur", "blur" }, { "bokeh", "defocus" },
  { "depth of field", "defocus", "multiplane" }, { "rack focus", "defocus", "multiplane" },
  { "lens blur", "defocus" }, { "directional", "blur" }, { "radial blur", "blur", "rays of light" },
  { "feather", "soft edge" }, { "light shaft", "rays of light" }, { "beam", "rays of light" },
  { "lighthouse", "rays of light" },
  { "light wrap", "mattes", "glow" },
  { "lens flare", "glow" }, { "bloom", "glow" }, { "lut", "grades" },
  { "color grading", "grades" }, { "color correction", "grades" }, { "curves", "grades" },
  { "levels", "grades" }, { "hue", "grades" }, { "saturation", "grades" }, { "contrast", "grades" },
  { "duotone", "grades" }, { "posterize", "grades" }, { "posterise", "grades" },
  { "colour wheel", "grades" }, { "color wheel", "grades" }, { "adjustment layer", "grades" },
  { "ocio", "colour profiles" }, { "icc", "colour profiles" }, { "film grain", "old film" },
  { "noise", "grain" }, { "turbulence", "noise" }, { "bluescreen", "blue screen" },
  { "track matte", "mattes" }, { "normal map", "relight" }, { "toon", "cel shading" },
  { "luma key", "mattes" }, { "alpha channel", "transparent" },
  { "background removal", "green screen", "mattes" }, { "transfer mode", "blend modes" },
  { "multiply", "blend modes" }, { "emboss", "lights" }, { "antialiasing", "antialias" },

  -- the camera and the picture
  { "crop", "viewport" }, { "resize", "scale" }, { "rotation", "rotate" },
  { "position", "translate" }, { "move", "translate", "keys" }, { "pan", "camera" },
  { "ken burns", "camera" }, { "parallax scroll", "parallax" }, { "2.5d", "multiplane" },
  { "depth sort", "multiplane" }, { "3d", "perspective" }, { "corner pin", "perspective" },
  { "shake", "camera shake" },
  { "stabilize", "track" }, { "precomp", "composition inside another" },
  { "nested composition", "composition inside another" },
  { "precomposition", "composition inside another" },

  { "displacement", "warp" },

  -- shapes, words and particles
  { "font", "text" }, { "typeface", "text" }, { "variable font", "text" },
  { "emoji", "glyphs", "text" }, { "kinetic typography", "letters" },
  { "text animation", "letters" }, { "text animator", "letters" }, { "caption", "subtitles" },
  { "trim path", "trim", "writing that appears" }, { "bezier", "path" },
  { "pathfinder", "merge", "booleans" },
  { "mask", "mattes", "clip" }, { "fill", "texture", "paint" }, { "outline", "lines" },
  { "progress bar", "number that counts up", "bar race" }, { "merge path", "merge" },
  { "offset path", "offset" }, { "grow", "offset" }, { "inset", "offset" },
  { "round corner", "round_corners", "rect" }, { "zig zag", "zigzag" }, { "bloat", "pucker" },
  { "polystar", "star" }, { "regular polygon", "star" }, { "path operator", "path operators" },
  { "width along a stroke", "brush" }, { "gradient along or across a stroke", "brush" },
  { "conic gradient", "conic" }, { "angular gradient", "conic" }, { "sweep gradient", "conic" },
  { "mesh gradient", "gradient" }, { "ink line", "outline", "trace" }, { "fire", "particles" },
  { "smoke", "particles" }, { "explosion", "particles" }, { "dust", "particles" },
  { "shape tween", "morph" }, { "photo", "pictures" }, { "wave", "reflection in water", "paths" },
  { "boat", "keys", "reflection in water" }, { "sea", "reflection in water" },
  { "title fade", "crossfade", "letters" }, { "fade in", "crossfade", "ease" },

  -- files and programs
  { "gif", "videos" }, { "mp4", "videos" }, { "webm", "videos" }, { "prores", "videos" },
  { "codec", "videos" }, { "export", "output" }, { "looping gif", "videos" },
  { "psd", "layered paintings" }, { "photoshop", "layered paintings" },
  { "krita", "layered paintings" }, { "illustrator", "drawings" }, { "inkscape", "drawings" },
  { "vectorize", "trace" }, { "vectorise", "trace" }, { "cleanup", "trace" }, { "scan", "trace" },
  { "audio", "sound" }, { "music", "sound" }, { "beat", "drawings that follow a sound" },
  { "amplitude", "drawings that follow a sound" }, { "spectrum", "drawings that follow a sound" },
  { "several sounds", "mix of sounds" }, { "scrub", "watch" }, { "paint fill", "trace" },
  { "lottie", "drawings" }, { "aseprite", "sprite sheet" }, { "tracker", "track" },
  { "hdr", "formats" }, { "cryptomatte", "mattes" }, { "colour script", "contact" },
  { "color script", "contact" },
  { "footage", "pictures" }, { "render queue", "farms" }, { "batch", "farms", "parameters" },
  { "template", "parameters" }, { "preview", "watch" }, { "storyboard", "contact" },
  { "animatic", "the cut" }, { "onion", "onion skin" }, { "thumbnail", "contact" },
}
