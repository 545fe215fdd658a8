-- Asks the program for the frames of the examples that are drawn where they stand in the site, as
-- digests.mjs reads them. From the top of the tree:
--
--   lua5.4 tests/page/blocks.lua BINARY FOLDER > QUESTIONS
--
-- FOLDER: for the examples, and the files that they read. What the program refuses is not asked.
package.path = "./?.lua;" .. package.path
local markdown = require "tests.support.markdown"
local system = require "tests.support.system"

local binary, folder = ...
assert(binary and folder, "usage: lua5.4 tests/page/blocks.lua BINARY FOLDER > QUESTIONS")

--- Whether it is a script with a name that makes a film.
local function is_whole(block)
  return block.language == "lua" and block.name and block.text:find "\nreturn "
    and not block.text:find "^%-%- error:" and not block.text:find "^%-%- %w+%.lua: a module"
end

--- A question and its answer: of the first frame and the ninth, or of the only one.
local function ask(block)
  local question = ("render %s/%s --allow %s --size 96x54 --frames "):format(folder, block.file,
    folder)
  for _, frames in ipairs { "1,9", "1" } do
    local answer = system.output(("'%s' %s%s --hash --progress none 2>/dev/null"):format(binary,
      question, frames))
    if answer ~= "" then return question .. frames .. "\n" .. answer end
  end
end

assert(os.execute(("rm -rf '%s' && mkdir -p '%s'"):format(folder, folder)))
local FILES = "drawings paintings pencil pictures stage town type demo/line.tsv" -- in scripts/
assert(os.execute(("cd scripts && cp -r %s '%s'"):format(FILES,
  system.output("realpath '" .. folder .. "'"):match "[^\n]+")))
local pages = { "README.md" }
for path in system.output "ls docs/*.md":gmatch "[^\n]+" do pages[#pages + 1] = path end
for _, page in ipairs(pages) do
  markdown.save(page, folder, function(block)
    return block.language == "text" or block.language == "lua" and block.name
  end)
end
for _, page in ipairs(pages) do
  for _, block in ipairs(markdown.blocks(page)) do
    local asked = is_whole(block) and ask(block)
    if asked then print(asked) end
  end
end
