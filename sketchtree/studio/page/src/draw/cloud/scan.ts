// Points of a scan, as the program sends them: x, y, z of each as 32 bits (metres, y up, the foot at the origin), then red, green and blue of each as 8 bits, where they are coloured.

import type { Cloud } from "../../messages";
import type { Store } from "../../store";

export interface Scan {
  digest: string;
  xyz: Float32Array;
  rgb: Uint8Array | null;
}

export function readScan(cloud: Pick<Cloud, "digest" | "count" | "coloured">, bytes: ArrayBuffer): Scan {
  const count = cloud.count ?? 0;
  return { digest: cloud.digest, xyz: new Float32Array(bytes, 0, 3 * count), rgb: cloud.coloured ? new Uint8Array(bytes, 12 * count, 3 * count) : null };
}

/** The points behind the drawing come as soon as they are named, and go with them. */
export function followScan(store: Store): void {
  let wanted: string | null = null;
  store.on("cloud", () => {
    const { cloud } = store.known;
    if ((cloud?.digest ?? null) === wanted) return;
    wanted = cloud?.digest ?? null;
    store.scanned(null);
    if (cloud) {
      void store.bytes(`/cloud/${cloud.digest}`).then(
        (bytes) => { if (wanted === cloud.digest) store.scanned(readScan(cloud, bytes)); },
        () => { if (wanted === cloud.digest) wanted = null; }, // asked again with the next change
      );
    }
  });
}
