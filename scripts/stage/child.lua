local function none() return union {} end
local art = assert(svg.read "drawings/child.svg"):with { scarf = none,
  ["scarf end"] = none, umbrella = none }
local bones = { { "coat", from = "hip", to = "neck" },
  { "head", from = "neck", to = "crown" } }
for _, side in ipairs { " near", " far" } do
  bones[#bones + 1] = { "thigh" .. side, from = "hip", to = "knee" .. side }
  bones[#bones + 1] = { "shin" .. side, from = "knee" .. side, to = "ankle" .. side,
    limits = { 0, 150 } }
  bones[#bones + 1] = { "upper" .. side, from = "shoulder", to = "elbow" .. side,
    parent = "coat" }
end
local child = puppet { art = art, bones = bones, switches = { "eye" } }

return child
