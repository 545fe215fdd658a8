--- What a video has beside the pictures of its frames: a rate of its own, chapters, captions, and
--- the poster of the film.
---
---   film{ poster = "2s" } --> mp4: an attached picture;  mov, mkv, webm: film.poster.png beside it
local program, request, script, target = ...

local FRAMES_MOST = 10000000
local CHAPTERS_MOST = 120000 -- bytes of an argument of a program, which Linux limits to 131,072
local NAME_MOST = 200 -- bytes of the title of a chapter

local video = {}
local poster = script.has_poster and target.poster == "beside"
  and request.output:gsub("([^/.])%.[^/.]*$", "%1") .. ".poster.png"

--- The frames that are shown at the times of frames of the rate --fps, while those of `played` are
--- shown one after the other: some are left out, or occur several times in a row.
function video.at_rate(played)
  local above, below = request.fps:match "^(.*)/(.*)$"
  local ratio = (above or request.fps) / (below or 1) / script.fps
  local count, numbers = math.max(1, math.floor(#played * ratio + 0.5)), {}
  if count > FRAMES_MOST then program.fail("limit", "--fps: more than %d frames", FRAMES_MOST) end
  for i = 0, count - 1 do
    -- a frame begins at its time, however the quotient is rounded
    numbers[i + 1] = played[math.min(math.floor(i / ratio + 1e-6), #played - 1) + 1]
  end
  return numbers
end

--- Whether each frame is the one after the frame before it.
local function is_run(numbers)
  for i = 2, #numbers do
    if numbers[i] ~= numbers[i - 1] + 1 then return false end
  end
  return true
end

--- The marks of the film as chapters, from the first frame that is played, in a format of ffmpeg,
--- ffmetadata: https://ffmpeg.org/ffmpeg-formats.html#Metadata-1. Those for which there is no room
--- are left out.
local function chapters_of(first, stop)
  local text = "data:text/plain,;FFMETADATA1\n"
  local function milliseconds(frame)
    return math.floor((frame - first) / script.fps * 1000 + 0.5)
  end
  for i, mark in ipairs(script.marks) do
    local begin, finish, name = math.max(mark.frame, first), stop, mark.name
    for k = #script.marks, i + 1, -1 do
      local frame = script.marks[k].frame
      if frame > mark.frame then finish = math.min(frame, stop) end
    end
    if #name > NAME_MOST then name = name:sub(1, utf8.offset(name, 0, NAME_MOST + 1) - 1) end
    local chapter = ("[CHAPTER]\nTIMEBASE=1/1000\nSTART=%d\nEND=%d\ntitle=%s\n"):format(
      milliseconds(begin), milliseconds(finish), (name:gsub("[=;#\\\n]", "\\%0")))
    if finish > begin and #text + #chapter < CHAPTERS_MOST then text = text .. chapter end
  end
  return text
end

--- The captions while the frames are played.
local function captions_of(played)
  if script:captions() == "" then return nil end
  if not target.captions_form then
    program.note("%s: %s holds no captions: they are left out", request.output, target.format)
  elseif not is_run(played) then
    program.note("%s: its captions are left out, because they go with one run of frames such as "
      .. "10-20", request.output)
  else
    local text = script:captions(target.captions_form, (played[1] - script.first) / script.fps,
      #played / script.fps)
    return text ~= "" and text or nil
  end
end

--- Adds to the target what the video has.
function video.describe()
  local played = target.played or target.numbers
  target.captions = captions_of(played)
  if #script.marks > 0 and is_run(played) then
    target.chapters = chapters_of(played[1], played[#played] + 1)
  end
end

--- Whether the picture beside the video is there, or none is wanted.
function video.has_poster()
  local file = poster and io.open(poster, "rb")
  if file then file:close() end
  return not poster or file ~= nil
end

--- Writes the picture beside the complete video, if there is one. Returns the exit code.
function video.write_poster()
  if not poster then return 0 end
  if #poster > program.path_most then
    program.error("%s: the name of its poster would be too long", request.output)
    return 5
  end
  return script:write_poster(poster)
end

return video
