// Where are strokes kept that the program has not confirmed, should this page or its line end? In the browser's own database, project by project.

import type { Strokes } from "../messages";

export interface Kept {
  key: number;
  project: string;
  request: Strokes;
}

const NAME = "sketchtree-studio";
const ROOM = "strokes-on-their-way";

export class Shelf {
  private readonly database: Promise<IDBDatabase | null>;

  constructor(factory: IDBFactory | undefined = globalThis.indexedDB) {
    this.database = factory ? open(factory) : Promise.resolve(null);
  }

  async put(kept: Kept): Promise<void> {
    await this.act("readwrite", (room) => room.put(kept));
  }

  async remove(keys: number[]): Promise<void> {
    if (keys.length) await this.act("readwrite", (room) => keys.map((key) => room.delete(key))[0]!);
  }

  /** What an earlier visit left, oldest first. */
  async all(project: string): Promise<Kept[]> {
    const every = ((await this.act("readonly", (room) => room.getAll())) ?? []) as Kept[];
    return every.filter((kept) => kept.project === project).sort((a, b) => a.key - b.key);
  }

  /** A browser that keeps nothing (a private window, a full disk) still draws: the strokes then live in this page alone. */
  private async act<T>(mode: IDBTransactionMode, what: (room: IDBObjectStore) => IDBRequest<T>): Promise<T | null> {
    const database = await this.database;
    if (!database) return null;
    return new Promise((resolve) => {
      const step = database.transaction(ROOM, mode);
      const request = what(step.objectStore(ROOM));
      step.oncomplete = () => resolve(request.result);
      step.onerror = step.onabort = () => resolve(null);
    });
  }
}

function open(factory: IDBFactory): Promise<IDBDatabase | null> {
  return new Promise((resolve) => {
    try {
      const request = factory.open(NAME, 1);
      request.onupgradeneeded = () => request.result.createObjectStore(ROOM, { keyPath: "key" });
      request.onsuccess = () => resolve(request.result);
      request.onerror = request.onblocked = () => resolve(null);
    } catch {
      resolve(null);
    }
  });
}
