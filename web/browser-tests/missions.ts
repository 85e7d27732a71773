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

/** More than a slow way carries: a snapshot has 37 bytes a drone. */
export const kThousandDrones = `format: 1
name: a thousand drones
field: {size_m: [40, 40]}
targets:
  clusters: [{name: south, points_m: [[10, 8], [14, 9], [12, 12]]}]
drone_grid: {count: 1000}
control: {speed_limit_m_s: 0.5, rate_hz: 50}
safety: {separation_m: 0.2, wall_distance_m: 0.17}
`;
