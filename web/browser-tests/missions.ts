/** Three drones over 3 x 3 m around the origin, and nothing to look at. */
export const kEmptyField = `
format: 1
name: empty
field: {size_m: [3, 3], origin_m: [-1.5, -1.5]}
drones:
  - {id: cf1, start_m: [-0.5, 0]}
  - {id: cf2, start_m: [0, 0.5]}
  - {id: cf3, start_m: [0.5, 0]}
control: {speed_limit_m_s: 0.3}
safety: {separation_m: 0.2, wall_distance_m: 0.17}
`;
