// How many things go on at the same time?

import { expect, test } from "vitest";
import { Queue } from "../src/parts/queue";

interface Job {
  name: string;
  end: () => void;
  fail: () => void;
}

function started(queue: Queue<string>, begun: Job[], name: string): void {
  queue.add(name, () => new Promise<void>((end, fail) => { begun.push({ name, end, fail: () => fail(new Error(name)) }); }));
}

const turn = (): Promise<void> => new Promise((done) => { setTimeout(done); });

test("no more than so many go on, and the others follow in their order", async () => {
  const begun: Job[] = [];
  const queue = new Queue<string>(2, () => true);
  for (const name of ["a", "b", "c", "d"]) started(queue, begun, name);
  expect(begun.map((one) => one.name)).toEqual(["a", "b"]);
  begun[1]!.end();
  await turn();
  expect(begun.map((one) => one.name)).toEqual(["a", "b", "c"]);
});

test("one that fails makes room as well", async () => {
  const begun: Job[] = [];
  const queue = new Queue<string>(1, () => true);
  for (const name of ["a", "b"]) started(queue, begun, name);
  begun[0]!.fail();
  await turn();
  expect(begun.map((one) => one.name)).toEqual(["a", "b"]);
});

test("what nobody wants any more is passed over", async () => {
  const begun: Job[] = [];
  const gone = new Set<string>();
  const queue = new Queue<string>(1, (name) => !gone.has(name));
  for (const name of ["a", "b", "c"]) started(queue, begun, name);
  gone.add("b");
  begun[0]!.end();
  await turn();
  expect(begun.map((one) => one.name)).toEqual(["a", "c"]);
});
