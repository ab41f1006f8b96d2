// What may go on at the same time? So many of them; the others wait in their order, and what nobody wants any more is passed over.

export class Queue<T> {
  private readonly waiting: { of: T; begin: () => Promise<void> }[] = [];
  private going = 0;

  constructor(private readonly most: number, private readonly wanted: (of: T) => boolean) {}

  add(of: T, begin: () => Promise<void>): void {
    this.waiting.push({ of, begin });
    this.next();
  }

  private next(): void {
    while (this.going < this.most) {
      const one = this.waiting.shift();
      if (!one) return;
      if (!this.wanted(one.of)) continue;
      this.going++;
      const over = (): void => {
        this.going--;
        this.next();
      };
      one.begin().then(over, over);
    }
  }
}
