local function dancer(f)
  local turn = 12 * math.sin(4 * f.time)
  local skirt = path {
    d = "M158 92 L108 172 Q160 186 212 172 L162 92 Z",
    fill = "#23263f" }
  local arms = stroke {
    d = "M104 40 Q130 66 160 72 Q192 66 214 34",
    width = 9, cap = "round", fill = "#3a2f47" }
  local body = path { d = "M148 66 L172 66 L164 100 L156 100 Z", fill = "#23263f" }
  local head = circle { 160, 48, 13, fill = "#3a2f47" }
  return group { skirt, arms, body, head }:rotate(turn, 160, 172)
end

return dancer
