// Longitudes and latitudes on a plane where areas are true.

const EARTH_RADIUS = 6371007.2; // metres: of the sphere with the area of the WGS 84 ellipsoid

/**
 * Lambert's cylindrical projection of degrees, in metres: areas are true everywhere, angles in the middle of the latitudes
 * (Snyder, Map Projections: a Working Manual, 1987, section 10).
 */
export function equal_area(lonlat) {
  const radians = Math.PI / 180;
  let [south, north] = [90, -90];
  for (let i = 1; i < lonlat.length; i += 2) {
    if (lonlat[i] < south) south = lonlat[i];
    if (lonlat[i] > north) north = lonlat[i];
  }
  const stretch = Math.max(Math.cos(((south + north) / 2) * radians), 0.01); // near a pole there is no such map
  return lonlat.map((value, i) =>
    i % 2 ? (EARTH_RADIUS * Math.sin(value * radians)) / stretch : EARTH_RADIUS * value * radians * stretch,
  );
}
