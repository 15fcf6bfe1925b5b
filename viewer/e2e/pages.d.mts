export function program(): string;
export function makePages(folder: string): string;
